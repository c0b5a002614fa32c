#include "redbee/node/frame_order.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

using Verdict = FrameDecision;
constexpr Duration kPeriod(41'667);

CameraTime at(Duration since_begin) { return CameraTime(since_begin); }

TEST(FrameOrder, TakesFramesInOrderOfTime) {
  FrameOrder order;
  for (int64_t k = 1; k < 5; ++k) EXPECT_EQ(order.classify(at(k * kPeriod)), Verdict::kNext);
}

TEST(FrameOrder, LeavesOutWhatComesLateOrTwice) {
  FrameOrder order;
  order.classify(at(3 * kPeriod));
  EXPECT_EQ(order.classify(at(3 * kPeriod)), Verdict::kDiscard);
  EXPECT_EQ(order.classify(at(2 * kPeriod)), Verdict::kDiscard);
  EXPECT_EQ(order.classify(at(4 * kPeriod)), Verdict::kNext);
  EXPECT_EQ(order.last(), at(4 * kPeriod));
}

TEST(FrameOrder, FollowsAClockThatWasSetFarBackAtOnce) {
  FrameOrder order;
  order.classify(at(std::chrono::hours(1)));
  EXPECT_EQ(order.classify(at(Duration(5))), Verdict::kRestart);
  EXPECT_EQ(order.classify(at(Duration(5) + kPeriod)), Verdict::kNext);
}

TEST(FrameOrder, FollowsAClockThatWasSetBackALittleAfterSomeFrames) {
  FrameOrder order;
  order.classify(at(std::chrono::seconds(1)));
  CameraTime time = at(std::chrono::milliseconds(500));
  for (int i = 1; i < FrameOrder::kRestartAfter; ++i) {
    EXPECT_EQ(order.classify(time), Verdict::kDiscard);
    time += kPeriod;
  }
  EXPECT_EQ(order.classify(time), Verdict::kRestart);
  EXPECT_EQ(order.classify(time + kPeriod), Verdict::kNext);
}

TEST(FrameOrder, StrayOldFramesBetweenGoodOnesNeverAddUp) {
  FrameOrder order;
  for (int64_t k = 10; k < 40; ++k) {
    EXPECT_EQ(order.classify(at(k * kPeriod)), Verdict::kNext);
    EXPECT_EQ(order.classify(at((k - 5) * kPeriod)), Verdict::kDiscard);
  }
}

}  // namespace
}  // namespace redbee
