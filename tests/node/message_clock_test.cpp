#include "redbee/node/message_clock.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

using namespace std::chrono_literals;

constexpr CameraTime kFrame(std::chrono::seconds(1'700'000'000));

ImuTime sensor(Duration after_frame) { return toImu(kFrame, after_frame); }

TEST(MessageClock, GoesWithFramesAndSensors) {
  MessageClock clock;
  EXPECT_EQ(clock.now(), CameraTime());
  clock.noteOther(sensor(0ms));
  clock.noteFrame(kFrame);
  clock.noteOther(sensor(100ms));
  clock.noteOther(sensor(90ms));
  EXPECT_EQ(clock.now(), kFrame + 100ms);
  clock.noteFrame(kFrame + 200ms);
  EXPECT_EQ(clock.now(), kFrame + 200ms);
}

TEST(MessageClock, TheDifferenceOfTheClocksIsNoTime) {
  for (const Duration difference : {Duration(-1h), Duration(-500ms), Duration(500ms), Duration(1h)}) {
    MessageClock clock;
    clock.noteOther(sensor(difference));
    clock.noteFrame(kFrame);
    clock.noteOther(sensor(difference + 10ms));
    EXPECT_EQ(clock.now(), kFrame + 10ms);
  }
}

TEST(MessageClock, AJumpOfASensorsTimeIsNoTime) {
  MessageClock clock;
  clock.noteOther(sensor(0ms));
  clock.noteFrame(kFrame);
  for (const ImuTime stray : {ImuTime::max(), ImuTime::min(), sensor(1h), sensor(-1h), sensor(500ms)}) {
    clock.noteOther(stray);
    EXPECT_EQ(clock.now(), kFrame);
  }
  clock.noteOther(sensor(501ms));
  EXPECT_EQ(clock.now(), kFrame + 1ms);
}

TEST(MessageClock, RestartsWhereTimeIsSetBack) {
  MessageClock clock;
  clock.noteFrame(kFrame);
  clock.restart();
  clock.noteFrame(kFrame - 5s);
  EXPECT_EQ(clock.now(), kFrame - 5s);
}

}  // namespace
}  // namespace redbee
