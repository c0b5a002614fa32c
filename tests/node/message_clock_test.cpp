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
  clock.noteFrame(kFrame);
  clock.noteOther(sensor(100ms));
  clock.noteOther(sensor(90ms));
  EXPECT_EQ(clock.now(), kFrame + 100ms);
  clock.noteFrame(kFrame + 200ms);
  EXPECT_EQ(clock.now(), kFrame + 200ms);
}

TEST(MessageClock, IgnoresATimeThatIsFarOff) {
  MessageClock clock;
  clock.noteFrame(kFrame);
  for (const ImuTime stray : {ImuTime::max(), ImuTime::min(), sensor(1h), sensor(-1h)}) {
    clock.noteOther(stray);
    EXPECT_EQ(clock.now(), kFrame);
  }
  clock.noteOther(sensor(1us));
  EXPECT_EQ(clock.now(), kFrame + 1us);
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
