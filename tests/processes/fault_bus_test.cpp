// Faults of the bus and of other publishers: lost, duplicate and reordered messages, other publishers,
// clocks.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/fault_trial.hpp"
#include "tests/support/killable_stack.hpp"
#include "tests/support/lossy_bus.hpp"

namespace redbee::test {
namespace {

StackOutput runLossy(const StackFlight& flight, const PacketFaults& faults, unsigned seed) {
  const auto bus = makeLcmBus("memq://");
  LossyBus lossy(*bus, faults, seed);
  StackOutput output = StackRun(flight, lossy).run([&](const SensorMessage& sent) {
    lossy.disturbed = isDisturbed(flight, sent.utime);
  });
  EXPECT_EQ(lossy.handlerFailures(), 0);
  return output;
}

void expectAllKindsSurvived(double probability, int within_frames) {
  const int percent = static_cast<int>(std::lround(100 * probability));
  const struct {
    const char* name;
    PacketFaults faults;
  } kinds[] = {{"lost", {probability, 0, 0}},
               {"duplicated", {0, probability, 0}},
               {"reordered", {0, 0, probability}},
               {"lost, duplicated, reordered", {probability, probability, probability}}};
  unsigned seed = 1;
  for (const auto& kind : kinds) {
    const StackOutput output = runLossy(undisturbedFlight(), kind.faults, seed++);
    expectRecovery(std::to_string(percent) + " % " + kind.name, output, undisturbedFlight(), within_frames);
  }
}

TEST(BusFault, UndisturbedRunsAgree) {
  const Damage damage = assess(StackRun(undisturbedFlight()).run(), undisturbedFlight());
  EXPECT_EQ(damage.frames_to_recovery, 0);
  EXPECT_EQ(damage.without_mask, 0);
  EXPECT_LT(damage.worst_px, 0.3);
}

TEST(BusFault, OnePercentOfPackets) { expectAllKindsSurvived(0.01, 24); }
TEST(BusFault, FivePercentOfPackets) { expectAllKindsSurvived(0.05, 24); }
TEST(BusFault, TwentyPercentOfPackets) { expectAllKindsSurvived(0.2, 24); }

TEST(BusFault, RandomBytesOnEveryChannel) {
  StackFlight flight = undisturbedFlight();
  std::mt19937 random(7);
  const Channels& c = flight.configuration.channels;
  std::vector<SensorMessage> with_rubbish;
  for (const SensorMessage& sent : flight.messages) {
    with_rubbish.push_back(sent);
    if (!isDisturbed(flight, sent.utime) || sent.channel != "CAMERA") continue;
    for (const std::string& channel : {c.camera, c.imu, c.altimeter, c.inertial_homography, c.filter_snapshot,
                                       c.warm_start, c.visual_homography, c.fused_homography}) {
      std::vector<uint8_t> rubbish(std::uniform_int_distribution<size_t>(0, 2000)(random));
      for (uint8_t& byte : rubbish) byte = static_cast<uint8_t>(random());
      with_rubbish.push_back({sent.utime, channel, rubbish});
    }
  }
  flight.messages = with_rubbish;
  const StackOutput output = StackRun(flight).run();
  expectRecovery("random bytes on every channel", output, flight, 0);
  EXPECT_GE(output.health.at("redbee-imu-integration").damaged, kFaultEnd - kFaultBegin);
}

/// Decodable messages with wrong values: one bit flipped anywhere after the hash.
TEST(BusFault, FlippedBitsInEveryKindOfMessage) {
  StackFlight flight = undisturbedFlight();
  std::mt19937 random(8);
  for (SensorMessage& sent : flight.messages) {
    if (!isDisturbed(flight, sent.utime) || random() % 20 != 0) continue;
    const size_t at = kHashBytes + random() % std::min<size_t>(sent.data.size() - kHashBytes, 120);
    sent.data[at] = static_cast<uint8_t>(sent.data[at] ^ (1U << (random() % 8)));
  }
  expectRecovery("a bit flipped in 5 % of messages", StackRun(flight).run(), flight, 30);
}

TEST(BusFault, TimesThatNoClockShows) {
  StackFlight flight = undisturbedFlight();
  std::mt19937 random(9);
  const int64_t times[] = {
      std::numeric_limits<int64_t>::max(),    std::numeric_limits<int64_t>::min(),   0, -1,
      flight.frame_utimes[0] + 3'600'000'000, flight.frame_utimes[0] - 3'600'000'000};
  std::vector<SensorMessage> messages;
  for (const SensorMessage& sent : flight.messages) {
    messages.push_back(sent);
    if (!isDisturbed(flight, sent.utime) || random() % 20 != 0 || sent.channel != "IMU") continue;
    ins_t stray;
    ASSERT_TRUE(decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), stray));
    stray.utime = times[random() % 6];
    messages.push_back(encoded(stray));
  }
  flight.messages = messages;
  expectRecovery("IMU times that no clock shows", StackRun(flight).run(), flight, 0);
}

TEST(BusFault, ACameraTimeThatNoClockShows) {
  for (const int64_t utime : {std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min(),
                              undisturbedFlight().frame_utimes[0] + 3'600'000'000}) {
    StackFlight flight = undisturbedFlight();
    const SensorMessage first = *std::find_if(
        flight.messages.begin(), flight.messages.end(),
        [&](const SensorMessage& a) { return a.channel == "CAMERA" && a.utime == beginTime(flight); });
    image_t stray;
    ASSERT_TRUE(decodeMessage(first.data.data(), static_cast<int>(first.data.size()), stray));
    stray.utime = utime;
    const auto place = std::find_if(flight.messages.begin(), flight.messages.end(),
                                    [&](const SensorMessage& a) { return a.utime >= beginTime(flight); });
    flight.messages.insert(place, {beginTime(flight), "CAMERA", encodeMessage(stray)});
    expectRecovery("one camera time that no clock shows", StackRun(flight).run(), flight, 24);
  }
}

/// The clock of all sensors jumps ahead by five seconds for the stretch, and back after it.
TEST(BusFault, ClocksThatJumpAheadAndBack) {
  StackFlight flight = undisturbedFlight();
  const auto shifted = [](int64_t utime) { return utime + 5'000'000; };
  flight = withChanged<image_t>(flight, "CAMERA", [&](image_t& m) { m.utime = shifted(m.utime); });
  flight = withChanged<ins_t>(flight, "IMU", [&](ins_t& m) { m.utime = shifted(m.utime); });
  flight = withChanged<altimeter_t>(flight, "ALTIMETER", [&](altimeter_t& m) { m.utime = shifted(m.utime); });
  expectRecovery("clocks jump 5 s ahead and back", StackRun(flight).run(), flight, 30);
}

TEST(BusFault, TheImusClockAloneJumps) {
  const StackFlight flight =
      withChanged<ins_t>(undisturbedFlight(), "IMU", [](ins_t& m) { m.utime += 3'600'000'000; });
  expectRecovery("the IMU's clock is an hour ahead", StackRun(flight).run(), flight, 30);
}

StackFlight withSecondPublisher(const std::string& channel, int64_t delay_us) {
  StackFlight flight = undisturbedFlight();
  std::vector<SensorMessage> both = flight.messages;
  for (const SensorMessage& sent : flight.messages) {
    if (sent.channel != channel || !isDisturbed(flight, sent.utime)) continue;
    SensorMessage other = sent;
    if (channel == "CAMERA") {
      cv::Mat noise(kFaultHeight, kFaultWidth, CV_8U);
      cv::RNG(static_cast<uint64_t>(sent.utime)).fill(noise, cv::RNG::UNIFORM, 0, 255);
      other = encoded(rawGreyMessage(sent.utime + delay_us, noise));
    } else {
      ins_t wrong{};
      wrong.utime = sent.utime + delay_us;
      wrong.accel[2] = 9.81;
      other = encoded(wrong);
    }
    both.push_back(other);
  }
  flight.messages = both;
  sortByTime(flight.messages);
  return flight;
}

TEST(BusFault, TwoPublishersOnOneChannel) {
  const StackFlight cameras = withSecondPublisher("CAMERA", 17'000);
  expectRecovery("a second camera on CAMERA", StackRun(cameras).run(), cameras, 30);
  const StackFlight imus = withSecondPublisher("IMU", 1'000);
  const StackOutput output = StackRun(imus).run();
  const Damage damage = expectRecovery("a second, resting IMU on IMU", output, imus, 1);
  EXPECT_LT(damage.worst_px, 0.1);
  EXPECT_EQ(output.health.at("redbee-imu-integration").message, "IMU: a second source is ignored");
}

/// The whole stack started twice by mistake: every process publishes twice on each channel.
TEST(BusFault, TwoStacksAtOnce) {
  const StackFlight& flight = undisturbedFlight();
  const auto bus = makeLcmBus("memq://");
  std::unique_ptr<KillableStack> second;
  bool over = false;
  const StackOutput output = StackRun(flight, *bus).run([&](const SensorMessage& sent) {
    if (!second && isDisturbed(flight, sent.utime)) {
      second = std::make_unique<KillableStack>(*bus, flight.configuration);
    }
    if (second && !over && sent.utime >= endTime(flight)) {
      for (const ProcessDescription* stage : kStages) second->kill(*stage);
      over = true;
    }
    if (second && !over) second->settle();
  });
  expectRecovery("the stack runs twice", output, flight, 24);
}

}  // namespace
}  // namespace redbee::test
