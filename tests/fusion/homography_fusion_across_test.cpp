// The fusion where vision skips frames that the IMU knows.
#include <gtest/gtest.h>

#include <cstdio>

#include "redbee/fusion/estimate.hpp"
#include "redbee/fusion/homography_fusion.hpp"
#include "tests/support/fusion_inputs.hpp"

namespace redbee::test {
namespace {

/// Where vision skips every other frame, the way across is known as well as if that frame had never been.
TEST(HomographyFusion, AcrossAFrameThatVisionSkippedItIsAsGoodAsOneStep) {
  double error_across = 0, error_of_one = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    FusionInputs inputs(seed);
    HomographyFusion fusion = makeFusion(), of_one = makeFusion();
    for (int k = 2; k <= 40; k += 2) {
      const InertialInput first = inputs.inertial(k - 2, k - 1), second = inputs.inertial(k - 1, k);
      const VisualInput visual = inputs.visual(k - 2, k);
      fusion.step(frameTime(k - 1), first, std::nullopt);
      fusion.step(frameTime(k), second, visual);
      error_across += inputs.error(fusion.since(frameTime(k - 2)).value(), k - 2, k);

      const ImageScaling scaling(kWidth, kHeight);
      const Estimate both =
          composed({scaling.scale(second.H), second.covariance}, {scaling.scale(first.H), first.covariance});
      const InertialInput whole{frameTime(k - 2), scaling.unscale(both.H), both.P};
      error_of_one += inputs.error(of_one.step(frameTime(k), whole, visual).H_step, k - 2, k);
    }
  }
  std::printf("across %.3f px, of one step %.3f px\n", error_across / 200, error_of_one / 200);
  EXPECT_LT(error_across, 1.02 * error_of_one);
}

TEST(HomographyFusion, AStepThatWasNotPublishedIsNotCorrected) {
  constexpr double kQuiet = 1e-4;
  FusionInputs inputs(7);
  HomographyFusion fusion(kWidth, kHeight, {});
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  const auto unused = fusion.step(frameTime(1), inputs.inertial(0, 1, 4e-4, 3.0 / kFrameRate), std::nullopt);
  ASSERT_EQ(unused.source, FusionSource::kNone);
  const auto next = fusion.step(frameTime(2), inputs.inertial(1, 2, kQuiet, kQuiet), inputs.visual(0, 2));
  EXPECT_EQ(next.source, FusionSource::kFused) << "it is good by itself";
  EXPECT_LT(inputs.error(next.H_step, 1, 2), 1);
}

TEST(HomographyFusion, ACorrectionAcrossSkippedFramesNeverMakesAStepUseless) {
  HomographyFusion fusion(kWidth, kHeight, {});
  FusionInputs inputs(8);
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  // Each step is just good enough; two of them and a third in one would not be.
  for (double error = 0.2; error > 0.001; error *= 0.9) {
    HomographyFusion tried = fusion;
    if (tried.step(frameTime(1), inputs.inertial(0, 1, 4e-4, error), std::nullopt).source ==
        FusionSource::kNone)
      continue;
    tried.step(frameTime(2), inputs.inertial(1, 2, 4e-4, error), std::nullopt);
    const auto back = tried.step(frameTime(3), inputs.inertial(2, 3, 4e-4, error), inputs.visual(0, 3));
    EXPECT_EQ(back.source, FusionSource::kFused) << error;
    return;
  }
  FAIL() << "no step is good enough";
}

}  // namespace
}  // namespace redbee::test
