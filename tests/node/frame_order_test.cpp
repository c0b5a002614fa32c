#include "redbee/node/frame_order.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {
constexpr Duration kPeriod(41'667);

CameraTime at(Duration since_begin) { return CameraTime(since_begin); }

TEST(FrameOrder, TakesFramesInOrderOfTime) {
  FrameOrder order;
  for (int64_t k = 1; k < 5; ++k) EXPECT_EQ(order.classify(at(k * kPeriod)), FrameDecision::kNext);
}

TEST(FrameOrder, LeavesOutWhatComesLateOrTwice) {
  FrameOrder order;
  order.classify(at(3 * kPeriod));
  EXPECT_EQ(order.classify(at(3 * kPeriod)), FrameDecision::kDiscard);
  EXPECT_EQ(order.classify(at(2 * kPeriod)), FrameDecision::kDiscard);
  EXPECT_EQ(order.classify(at(4 * kPeriod)), FrameDecision::kNext);
  EXPECT_EQ(order.last(), at(4 * kPeriod));
}

TEST(FrameOrder, FollowsAClockThatWasSetFarBackAtOnce) {
  FrameOrder order;
  order.classify(at(std::chrono::hours(1)));
  EXPECT_EQ(order.classify(at(Duration(5))), FrameDecision::kRestart);
  EXPECT_EQ(order.classify(at(Duration(5) + kPeriod)), FrameDecision::kNext);
}

TEST(FrameOrder, FollowsAClockThatWasSetBackALittleAfterSomeFrames) {
  FrameOrder order;
  order.classify(at(std::chrono::seconds(1)));
  CameraTime time = at(std::chrono::milliseconds(500));
  for (int i = 1; i < FrameOrder::kRestartAfter; ++i) {
    EXPECT_EQ(order.classify(time), FrameDecision::kDiscard);
    time += kPeriod;
  }
  EXPECT_EQ(order.classify(time), FrameDecision::kRestart);
  EXPECT_EQ(order.classify(time + kPeriod), FrameDecision::kNext);
}

TEST(FrameOrder, StrayOldFramesBetweenGoodOnesNeverAddUp) {
  FrameOrder order;
  for (int64_t k = 10; k < 40; ++k) {
    EXPECT_EQ(order.classify(at(k * kPeriod)), FrameDecision::kNext);
    EXPECT_EQ(order.classify(at((k - 5) * kPeriod)), FrameDecision::kDiscard);
  }
}

}  // namespace
}  // namespace redbee
