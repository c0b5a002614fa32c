#include "redbee/node/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <initializer_list>

namespace redbee {
namespace {

int64_t lostAfter(std::initializer_list<int32_t> sequences) {
  SequenceCounter counter;
  for (const int32_t sequence : sequences) counter.note(sequence);
  return counter.lost();
}

TEST(SequenceCounter, GapsAreLosses) {
  EXPECT_EQ(lostAfter({0, 1, 2, 3}), 0);
  EXPECT_EQ(lostAfter({0, 1, 3}), 1);
  EXPECT_EQ(lostAfter({0, 5, 6, 10}), 7);
  EXPECT_EQ(lostAfter({0, 1000000}), 999999);
}

TEST(SequenceCounter, JoiningLateIsNoLoss) { EXPECT_EQ(lostAfter({500, 501}), 0); }

TEST(SequenceCounter, RestartIsNoLoss) {
  EXPECT_EQ(lostAfter({7, 8, 9, 0, 1, 2}), 0);
  EXPECT_EQ(lostAfter({500, 501, 3, 4}), 0) << "a restart whose first messages were lost";
  EXPECT_EQ(lostAfter({0, 2, 0, 1, 2, 4}), 2);
}

TEST(SequenceCounter, ALateMessageClosesItsGap) {
  EXPECT_EQ(lostAfter({0, 1, 3, 2, 4}), 0);
  EXPECT_EQ(lostAfter({0, 4, 2, 5}), 2);
}

TEST(SequenceCounter, ARepeatedMessageDoesNotCount) {
  EXPECT_EQ(lostAfter({0, 1, 1, 2, 3, 2, 4}), 0);
  EXPECT_EQ(lostAfter({5, 7, 7, 8}), 1);
}

TEST(MessageRate, CountsIntervalsInMessageTime) {
  MessageRate rate;
  EXPECT_EQ(rate.hertz(), 0);
  for (int i = 0; i < 25; ++i) rate.note(Duration(1000000 + i * 40000));
  EXPECT_NEAR(rate.hertz(), 25.0, 1e-9);
}

TEST(MessageRate, RestartsWhenTimeRunsBackwards) {
  MessageRate rate;
  rate.note(Duration(10000000));
  rate.note(Duration(1000000));
  EXPECT_EQ(rate.hertz(), 0);
  rate.note(Duration(1100000));
  EXPECT_NEAR(rate.hertz(), 10.0, 1e-9);
}

TEST(LatencyWindow, GivesPercentilesOfTheNewestValues) {
  LatencyWindow window;
  EXPECT_EQ(window.percentile(0.5), 0);
  for (int i = 100; i >= 1; --i) window.note(i);
  EXPECT_EQ(window.percentile(0.5), 50);
  EXPECT_EQ(window.percentile(0.99), 99);
  for (size_t i = 0; i < LatencyWindow::kWindow; ++i) window.note(7);
  EXPECT_EQ(window.percentile(0.99), 7) << "old values leave the window";
}

TEST(HealthMonitor, ReportsAllThatWasNoted) {
  HealthMonitor health("redbee-test", "cafe");
  health.noteInput(Duration(1000000));
  health.noteInput(Duration(1050000));
  health.noteReceived(Duration(1060000));
  health.notePublished(Duration(1000000));
  health.noteSkipped(3);
  health.noteDamaged();
  health.noteLate(2);
  health.noteSequence("A", 0);
  health.noteSequence("A", 3);
  health.noteSequence("B", 9);
  health.noteSequence("B", 11);
  health.noteLatency(4);
  health.noteWork(2.5);
  health.setState(HealthState::kDegraded, "no IMU");
  health.setCalibration("fits");
  const auto message = health.nextMessage();
  EXPECT_EQ(message.utime, 1060000);
  EXPECT_EQ(message.process, "redbee-test");
  EXPECT_EQ(message.pid, getpid());
  EXPECT_EQ(message.state, 2);
  EXPECT_EQ(message.message, "no IMU");
  EXPECT_NEAR(message.rate_in, 20, 1e-9);
  EXPECT_EQ(message.latency_median, 4);
  EXPECT_EQ(message.work_p99, 2.5);
  EXPECT_EQ(message.received, 3);
  EXPECT_EQ(message.published, 1);
  EXPECT_EQ(message.skipped, 3);
  EXPECT_EQ(message.lost, 3);
  EXPECT_EQ(health.lost("B"), 1);
  EXPECT_EQ(health.lost("never received"), 0);
  EXPECT_EQ(message.damaged, 1);
  EXPECT_EQ(message.late, 2);
  EXPECT_GT(message.resident, 1 << 20);
  EXPECT_EQ(message.configuration, "cafe");
  EXPECT_EQ(message.calibration, "fits");
  EXPECT_FALSE(message.version.empty());
  EXPECT_EQ(health.nextMessage().sequence, message.sequence + 1);
}

TEST(HealthMonitor, AChangeIsReportedOnce) {
  HealthMonitor health("redbee-test", "");
  EXPECT_TRUE(health.consumeChange()) << "the start is news";
  EXPECT_FALSE(health.consumeChange());
  health.setState(HealthState::kGood);
  EXPECT_TRUE(health.consumeChange());
  health.setState(HealthState::kGood);
  EXPECT_FALSE(health.consumeChange());
  health.setState(HealthState::kGood, "but slow");
  EXPECT_TRUE(health.consumeChange());
  health.setCalibration("does not fit");
  EXPECT_TRUE(health.consumeChange());
}

TEST(HealthMonitor, AMissingInputIsReportedAndHasNoRate) {
  HealthMonitor health("redbee-test", "");
  health.setState(HealthState::kGood);
  for (int i = 0; i < 10; ++i) health.noteInput(Duration(1000000 + i * 40000));
  health.consumeChange();
  health.setInputSilence(0.9);
  EXPECT_FALSE(health.consumeChange());
  EXPECT_NEAR(health.nextMessage().rate_in, 25, 1e-9);
  health.setInputSilence(3.4);
  EXPECT_TRUE(health.consumeChange());
  const auto quiet = health.nextMessage();
  EXPECT_EQ(quiet.state, 2);
  EXPECT_EQ(quiet.message, "no input for 3 s");
  EXPECT_EQ(quiet.rate_in, 0);
  health.setInputSilence(0);
  EXPECT_TRUE(health.consumeChange());
  EXPECT_EQ(health.nextMessage().state, 1);
}

TEST(HealthMonitor, StoppingIsNotOverwrittenByAMissingInput) {
  HealthMonitor health("redbee-test", "");
  health.setInputSilence(9);
  health.setState(HealthState::kStopping);
  EXPECT_EQ(health.nextMessage().state, 3);
  EXPECT_EQ(health.nextMessage().message, "");
}

TEST(HealthState, NamesAreReadBack) {
  for (int8_t number = 0; number <= 4; ++number) {
    const auto state = static_cast<HealthState>(number);
    EXPECT_EQ(healthStateOf(toString(state)), state);
  }
  EXPECT_FALSE(healthStateOf("splendid"));
}

}  // namespace
}  // namespace redbee
