// Stages that are slower than the camera: what they skip, how late they are, and what the frames that are
// answered are worth.
#include <gtest/gtest.h>

#include "tests/support/fault_trial.hpp"
#include "tests/support/slow_stack.hpp"

namespace redbee::test {
namespace {

constexpr int kLearned = 24;             ///< frames
constexpr int kEnd = kFaultFrames - 14;  ///< what comes later may not be answered before the flight ends

Quality report(const char* name, const Answers& answers) {
  return printed(name, qualityOf(answers, undisturbedFlight(), kLearned, kEnd), kEnd - kLearned);
}

/// The same stack with time enough, without each `skip`-th frame.
Quality evenShare(const char* name, int skip) {
  return report(name, runSlowly(undisturbedFlight(), {}, everyNth(undisturbedFlight(), kLearned, skip)));
}

void expectEvenShare(const char* name, const Slowness& slowness, double share, int skip) {
  const Quality even = evenShare("  every n-th frame not sent", skip);
  const Quality slow = report(name, runSlowly(undisturbedFlight(), slowness));
  const WaitParameters& waits = undisturbedFlight().configuration.waits;
  EXPECT_GE(slow.answered, share * (kEnd - kLearned) - 2);
  EXPECT_EQ(slow.trusted, slow.answered);
  EXPECT_LE(slow.longest_gap, 2);
  EXPECT_LE(slow.latest_s, waits.segmentation_s + 0.1);
  EXPECT_GE(slow.found, even.found - 0.02);
  EXPECT_LE(slow.false_area, even.false_area + 0.001);
}

TEST(Overload, ASlowSegmentationIsNoWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("segmentation takes 1.25 periods", {{&kMotionSegmentation, 1.25}}, 0.8, 5);
  expectEvenShare("segmentation takes 1.5 periods", {{&kMotionSegmentation, 1.5}}, 2.0 / 3, 3);
}

TEST(Overload, SlowVisionIsNoWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("vision takes 1.25 periods", {{&kVisualHomography, 1.25}}, 0.8, 5);
}

TEST(Overload, ASlowStackIsNoWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("vision 1.25, segmentation 1.2 periods",
                  {{&kVisualHomography, 1.25}, {&kMotionSegmentation, 1.2}}, 0.8, 5);
}

}  // namespace
}  // namespace redbee::test
