#include "redbee/fusion/homography_fusion.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "redbee/geometry/chi_square.hpp"
#include "tests/support/fusion_inputs.hpp"

namespace redbee::test {
namespace {

void expectCovariance(const Matrix8d& P) {
  EXPECT_TRUE(P.isApprox(P.transpose(), 1e-12) || P.isZero());
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix8d>(P).eigenvalues().minCoeff(), -1e-12 * (1 + P.trace()));
}

TEST(HomographyFusion, IsBetterThanEitherSourceAlone) {
  double inertial_sum = 0;
  double visual_sum = 0;
  double fused_sum = 0;
  constexpr int kFrames = 240;
  FusionInputs inputs(1);
  HomographyFusion fusion = makeFusion();
  for (int k = 1; k <= kFrames; ++k) {
    const InertialInput inertial = inputs.inertial(k - 1, k);
    const VisualInput visual = inputs.visual(k - 1, k);
    const FusedHomography out = fusion.step(frameTime(k), inertial, visual);
    inertial_sum += inputs.error(inertial.H, k - 1, k);
    visual_sum += inputs.error(visual.H, k - 1, k);
    fused_sum += inputs.error(out.H_step, k - 1, k);
    expectCovariance(out.covariance_step);
    expectCovariance(out.covariance_anchor);
  }
  std::cout << "mean transfer error: inertial " << inertial_sum / kFrames << " px, visual "
            << visual_sum / kFrames << " px, fused " << fused_sum / kFrames << " px\n";
  RecordProperty("inertial_px", std::to_string(inertial_sum / kFrames));
  RecordProperty("visual_px", std::to_string(visual_sum / kFrames));
  RecordProperty("fused_px", std::to_string(fused_sum / kFrames));
  EXPECT_LT(fused_sum, inertial_sum);
  EXPECT_LT(fused_sum, visual_sum);
}

TEST(HomographyFusion, CovarianceOfTheStepIsConsistent) {
  constexpr int kRuns = 100;
  constexpr int kFrames = 6;
  double sum = 0;
  for (unsigned run = 1; run <= kRuns; ++run) {
    FusionInputs inputs(run);
    HomographyFusion fusion = makeFusion();
    FusedHomography out;
    for (int k = 1; k <= kFrames; ++k) {
      out = fusion.step(frameTime(k), inputs.inertial(k - 1, k), inputs.visual(k - 1, k));
    }
    sum += inputs.normalisedErrorSquared(out, kFrames - 1, kFrames);
  }
  std::cout << "NEES of the step " << sum / kRuns << '\n';
  RecordProperty("nees", std::to_string(sum / kRuns));
  EXPECT_GT(sum, chiSquareQuantile(0.025, 8 * kRuns));
  EXPECT_LT(sum, chiSquareQuantile(0.975, 8 * kRuns));
}

TEST(HomographyFusion, OutliersWeakenVision) {
  const auto fractionOfVision = [](int outliers) {
    HomographyFusion fusion = makeFusion();
    const InertialInput inertial{frameTime(0), translation(0), 1e-6 * Matrix8d::Identity()};
    const VisualInput visual{frameTime(0), translation(1), 1e-6 * Matrix8d::Identity(), 100, outliers};
    return fusion.step(frameTime(1), inertial, visual).H_step(0, 2);
  };
  // Equal covariances meet in the middle; with as many outliers as inliers vision has half the weight.
  EXPECT_NEAR(fractionOfVision(0), 1.0 / 2, 1e-6);
  EXPECT_NEAR(fractionOfVision(100), 1.0 / 3, 1e-6);
  EXPECT_NEAR(fractionOfVision(300), 1.0 / 5, 1e-6);
}

TEST(HomographyFusion, PaperPresetGivesThePapersGainInPixels) {
  FusionParameters parameters = consistentNoise();
  parameters.noise = FusionNoise::kPaper;
  parameters.gate_probability = 1 - 1e-12;
  HomographyFusion fusion = makeFusion(parameters);
  const Matrix8d any = 1e-6 * Matrix8d::Identity();
  // P is 0 at the anchor, so S = Q + P_t. Along h13: gain 1 / (1 + 1e-4 * 2); along h23: 1 / (1 + 1e-3 * 2).
  const FusedHomography first = fusion.step(frameTime(1), InertialInput{frameTime(0), translation(0), any},
                                            VisualInput{frameTime(0), translation(1, 1), any, 50, 50});
  const double gain = 1 / (1 + 2e-4);
  EXPECT_NEAR(first.H_anchor(0, 2), gain, 1e-9);
  EXPECT_NEAR(first.H_anchor(1, 2), 1 / (1 + 2e-3), 1e-9);
  // Second step: the paper counts the old P = (1 - gain) Q again.
  const FusedHomography second = fusion.step(frameTime(2), InertialInput{frameTime(1), translation(0), any},
                                             VisualInput{frameTime(1), translation(1, 0), any, 50, 50});
  EXPECT_GT(second.H_step(0, 2), gain);
  EXPECT_LT(second.H_step(0, 2), 1);
}

TEST(HomographyFusion, DefaultPresetCountsOnlyTheStep) {
  HomographyFusion fusion = makeFusion();
  const Matrix8d equal = 1e-6 * Matrix8d::Identity();
  for (int k = 1; k <= 20; ++k) {
    const FusedHomography out =
        fusion.step(frameTime(k), InertialInput{frameTime(k - 1), translation(0), equal},
                    VisualInput{frameTime(k - 1), translation(1), equal, 100, 0});
    EXPECT_NEAR(out.H_step(0, 2), 0.5, 1e-3) << k;  // however much has piled up behind the anchor
  }
}

TEST(HomographyFusion, EpochsRenewTheAnchorAndComposeWithin) {
  FusionInputs inputs(3);
  HomographyFusion fusion = makeFusion();
  int32_t epoch = 0;
  int anchor = 0;
  for (int k = 1; k <= 240; ++k) {
    const FusedHomography out = fusion.step(frameTime(k), inputs.inertial(k - 1, k), inputs.visual(k - 1, k));
    ASSERT_NE(out.source, FusionSource::kNone) << k;
    if (out.epoch != epoch) {
      EXPECT_EQ(out.epoch, epoch + 1);
      EXPECT_EQ(out.time_anchor, frameTime(k));
      EXPECT_TRUE(out.H_anchor.isIdentity());
      EXPECT_LT(inputs.error(out.H_step, k - 1, k), 3);
      epoch = out.epoch;
      anchor = k;
    }
    EXPECT_EQ(out.time_anchor, frameTime(anchor));
  }
  EXPECT_GE(epoch, 1);
}

}  // namespace
}  // namespace redbee::test
