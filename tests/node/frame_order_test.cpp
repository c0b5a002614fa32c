#include "redbee/node/frame_order.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

using Verdict = FrameDecision;
constexpr int64_t kPeriod = 41'667;

TEST(FrameOrder, TakesFramesInOrderOfTime) {
  FrameOrder order;
  for (int64_t k = 1; k < 5; ++k) EXPECT_EQ(order.classify(k * kPeriod), Verdict::kNext);
}

TEST(FrameOrder, LeavesOutWhatComesLateOrTwice) {
  FrameOrder order;
  order.classify(3 * kPeriod);
  EXPECT_EQ(order.classify(3 * kPeriod), Verdict::kDiscard);
  EXPECT_EQ(order.classify(2 * kPeriod), Verdict::kDiscard);
  EXPECT_EQ(order.classify(4 * kPeriod), Verdict::kNext);
  EXPECT_EQ(order.last(), 4 * kPeriod);
}

TEST(FrameOrder, FollowsAClockThatWasSetFarBackAtOnce) {
  FrameOrder order;
  order.classify(3'600'000'000);
  EXPECT_EQ(order.classify(5), Verdict::kRestart);
  EXPECT_EQ(order.classify(5 + kPeriod), Verdict::kNext);
}

TEST(FrameOrder, FollowsAClockThatWasSetBackALittleAfterSomeFrames) {
  FrameOrder order;
  order.classify(1'000'000);
  int64_t utime = 500'000;
  for (int i = 1; i < FrameOrder::kRestartAfter; ++i) {
    EXPECT_EQ(order.classify(utime), Verdict::kDiscard);
    utime += kPeriod;
  }
  EXPECT_EQ(order.classify(utime), Verdict::kRestart);
  EXPECT_EQ(order.classify(utime + kPeriod), Verdict::kNext);
}

TEST(FrameOrder, StrayOldFramesBetweenGoodOnesNeverAddUp) {
  FrameOrder order;
  for (int64_t k = 10; k < 40; ++k) {
    EXPECT_EQ(order.classify(k * kPeriod), Verdict::kNext);
    EXPECT_EQ(order.classify((k - 5) * kPeriod), Verdict::kDiscard);
  }
}

}  // namespace
}  // namespace redbee
