#include "redbee/node/message_clock.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace redbee {
namespace {

constexpr int64_t kFrame = 1'700'000'000'000'000;

TEST(MessageClock, GoesWithFramesAndSensors) {
  MessageClock clock;
  EXPECT_EQ(clock.now(), 0);
  clock.noteFrame(kFrame);
  clock.noteOther(kFrame + 100'000);
  clock.noteOther(kFrame + 90'000);
  EXPECT_EQ(clock.now(), kFrame + 100'000);
  clock.noteFrame(kFrame + 200'000);
  EXPECT_EQ(clock.now(), kFrame + 200'000);
}

TEST(MessageClock, IsNotPutOutByATimeThatIsFarOff) {
  MessageClock clock;
  clock.noteFrame(kFrame);
  for (const int64_t stray : {std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min(),
                              kFrame + 3'600'000'000, kFrame - 3'600'000'000}) {
    clock.noteOther(stray);
    EXPECT_EQ(clock.now(), kFrame);
  }
  clock.noteOther(kFrame + 1);
  EXPECT_EQ(clock.now(), kFrame + 1);
}

TEST(MessageClock, RestartsWhereTimeIsSetBack) {
  MessageClock clock;
  clock.noteFrame(kFrame);
  clock.restart();
  clock.noteFrame(kFrame - 5'000'000);
  EXPECT_EQ(clock.now(), kFrame - 5'000'000);
}

}  // namespace
}  // namespace redbee
