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
  constexpr double kMissed = 0.02;  // of the moving area, as much more than by the even share, at most
  const Quality even = evenShare("  every n-th frame not sent", skip);
  const Quality slow = report(name, runSlowly(undisturbedFlight(), slowness));
  const WaitParameters& waits = undisturbedFlight().configuration.waits;
  EXPECT_GE(slow.answered, share * (kEnd - kLearned) - 2);
  EXPECT_EQ(slow.trusted, slow.answered);
  EXPECT_LE(slow.longest_gap, 2);
  EXPECT_LE(slow.latest_s, waits.segmentation_s + 0.1);
  EXPECT_GE(slow.found, even.found - kMissed);
  EXPECT_LE(slow.false_area, even.false_area + 0.001);
}

TEST(Overload, ASegmentationThatIsTooSlowAtAnyQualityIsHardlyWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("segmentation takes 1.39 periods", {{&kMotionSegmentation, 1.25 / kCosts[1]}}, 0.8, 5);
  expectEvenShare("segmentation takes 1.67 periods", {{&kMotionSegmentation, 1.5 / kCosts[1]}}, 2.0 / 3, 3);
}

TEST(Overload, ASlowSegmentationLeavesOutElementsBeforeFrames) {
  const Quality whole = report("in time", runSlowly(undisturbedFlight(), {}));
  for (const double periods : {1.05, 1.1}) {
    const Answers answers = runSlowly(undisturbedFlight(), {{&kMotionSegmentation, periods}});
    const Quality slow = report(("segmentation takes " + std::to_string(periods)).c_str(), answers);
    EXPECT_GE(answers.lowest, 1U) << periods;
    EXPECT_EQ(slow.answered, kEnd - kLearned) << periods;
    EXPECT_EQ(slow.trusted, slow.answered) << periods;
    EXPECT_GE(slow.found, whole.found - 0.05) << periods;
    EXPECT_LE(slow.false_area, whole.false_area + 0.001) << periods;
  }
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
