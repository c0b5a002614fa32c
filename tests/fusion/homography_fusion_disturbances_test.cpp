// The fusion with wrong, damaged, late or lost sources.
#include <gtest/gtest.h>

#include <limits>

#include "redbee/fusion/estimate.hpp"
#include "redbee/fusion/homography_fusion.hpp"
#include "tests/support/fusion_inputs.hpp"

namespace redbee::test {
namespace {

constexpr int kProven = 24;  ///< frames in which an IMU that has just started agrees

VisualInput wrongBy60px(FusionInputs& inputs, int k) {
  VisualInput wrong = inputs.visual(k - 1, k);
  wrong.H = translation(60) * wrong.H;
  return wrong;
}

TEST(HomographyFusion, AGrossVisualErrorIsRejectedAndLaterAccepted) {
  FusionInputs inputs(2);
  FusionParameters parameters = consistentNoise();
  HomographyFusion fusion = makeFusion(parameters);
  FusedHomography out;
  int k = 1;
  for (; k <= kProven; ++k) {
    out = fusion.step(frameTime(k), inputs.inertial(k - 1, k), inputs.visual(k - 1, k));
  }
  for (; k <= kProven + parameters.max_gated_in_a_row; ++k) {
    out = fusion.step(frameTime(k), inputs.inertial(k - 1, k), wrongBy60px(inputs, k));
    EXPECT_EQ(out.source, FusionSource::kInertial);
    EXPECT_GT(out.test_ratio, 1);
    EXPECT_FALSE(out.visual_accepted);
    EXPECT_LT(inputs.error(out.H_step, k - 1, k), 5);
  }
  const int32_t epoch = out.epoch;
  out = fusion.step(frameTime(k), inputs.inertial(k - 1, k), wrongBy60px(inputs, k));
  EXPECT_EQ(out.source, FusionSource::kVisual);
  EXPECT_EQ(out.epoch, epoch + 1);
}

/// Its clock or its mounting may be other than configured.
TEST(HomographyFusion, AnImuThatContradictsFromTheStartHasNoPrecedence) {
  FusionInputs inputs(2);
  HomographyFusion fusion = makeFusion();
  for (int k = 1; k <= 4 * kProven; ++k) {
    InertialInput wrong = inputs.inertial(k - 1, k);
    const bool contradicts = k % 3 != 0;  // it hardly turns now and then
    if (contradicts) wrong.H = translation(60) * wrong.H;
    const FusedHomography out = fusion.step(frameTime(k), wrong, inputs.visual(k - 1, k));
    EXPECT_EQ(out.source, contradicts ? FusionSource::kVisual : FusionSource::kFused);
    EXPECT_LT(inputs.error(out.H_step, k - 1, k), 5) << k;
  }
}

/// The first frame from which on vision that contradicts the IMU is rejected, where they agreed until then.
int framesUntilProven(double frame_rate) {
  const auto at = [&](int k) { return frameTime(k, kStart, frame_rate); };
  for (int agreed = 1;; ++agreed) {
    FusionInputs inputs(2);
    HomographyFusion fusion = makeFusion();
    FusedHomography out;
    for (int k = 1; k <= agreed + 1; ++k) {
      VisualInput visual = inputs.visual(k - 1, k);
      InertialInput inertial = inputs.inertial(k - 1, k);
      visual.time_previous = inertial.time_previous = at(k - 1);
      if (k > agreed) visual.H = translation(60) * visual.H;
      out = fusion.step(at(k), inertial, visual);
    }
    if (out.source == FusionSource::kInertial) return agreed;
  }
}

TEST(HomographyFusion, AnImuIsProvenByASecondNotByANumberOfFrames) {
  for (const int frame_rate : {10, 24, 60}) {
    const int agreed = framesUntilProven(frame_rate);
    EXPECT_GE(agreed, frame_rate) << frame_rate << " Hz";
    EXPECT_LE(agreed, frame_rate + 1)
        << frame_rate << " Hz";  // the contradiction itself weighs, rounding of times
  }
}

TEST(HomographyFusion, EitherSourceMayBeLostForASecondAndComeBack) {
  for (const bool vision_lost : {true, false}) {
    FusionInputs inputs(4);
    HomographyFusion fusion = makeFusion();
    for (int k = 1; k <= 96; ++k) {
      const bool lost = k > 36 && k <= 60;
      std::optional<InertialInput> inertial = inputs.inertial(k - 1, k);
      std::optional<VisualInput> visual = inputs.visual(k - 1, k);
      if (lost && vision_lost) visual.reset();
      if (lost && !vision_lost) inertial.reset();
      const FusedHomography out = fusion.step(frameTime(k), inertial, visual);
      const FusionSource alone = vision_lost ? FusionSource::kInertial : FusionSource::kVisual;
      EXPECT_EQ(out.source, lost ? alone : FusionSource::kFused) << k;
      EXPECT_LT(inputs.error(out.H_step, k - 1, k), 5) << k;  // no jump, on the way out or back
    }
  }
}

TEST(HomographyFusion, AnInertialStepOfUnknownVelocityIsNotUsedAlone) {
  FusionInputs inputs(4);
  HomographyFusion fusion(kWidth, kHeight, {});
  const double unknown_velocity = 3.0 / kFrameRate;  // m in a frame, at 3 m/s
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  const auto alone = fusion.step(frameTime(1), inputs.inertial(0, 1, 4e-4, unknown_velocity), std::nullopt);
  EXPECT_EQ(alone.source, FusionSource::kNone) << "by its covariance it may be off by many pixels";
  const auto both =
      fusion.step(frameTime(2), inputs.inertial(1, 2, 4e-4, unknown_velocity), inputs.visual(1, 2));
  EXPECT_EQ(both.source, FusionSource::kFused) << "it still knows the rotation, and vision knows the rest";
  const auto known = fusion.step(frameTime(3), inputs.inertial(2, 3), std::nullopt);
  EXPECT_EQ(known.source, FusionSource::kInertial);
}

TEST(HomographyFusion, VisionAcrossAFrameThatItDoesNotKnowMeasuresTheStepAfterIt) {
  constexpr double kQuiet = 1e-4;
  FusionInputs inputs(6);
  HomographyFusion fusion(kWidth, kHeight, {});
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  EXPECT_FALSE(fusion.step(frameTime(1), inputs.inertial(0, 1, kQuiet, kQuiet), std::nullopt).visual_step);
  const VisualInput across = inputs.visual(0, 2, 0.1);
  const FusedHomography second = fusion.step(frameTime(2), inputs.inertial(1, 2), across);
  ASSERT_TRUE(second.visual_step);
  EXPECT_LT(inputs.error(second.visual_step->H, 1, 2), 1);
  EXPECT_GT(second.visual_step->covariance.trace(), measurementCovariance(across, {}).trace())
      << "the first step's error adds to it";
  const VisualInput direct = inputs.visual(2, 3);
  const FusedHomography third = fusion.step(frameTime(3), inputs.inertial(2, 3), direct);
  ASSERT_TRUE(third.visual_step);
  EXPECT_EQ(third.visual_step->H, direct.H);
}

TEST(HomographyFusion, AStepTooUncertainToUseStillConnectsVisionAcrossIt) {
  FusionInputs inputs(7);
  HomographyFusion fusion(kWidth, kHeight, {});
  const double unknown_velocity = 3.0 / kFrameRate;
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  const auto unused = fusion.step(frameTime(1), inputs.inertial(0, 1, 4e-4, unknown_velocity), std::nullopt);
  ASSERT_EQ(unused.source, FusionSource::kNone);
  const auto across =
      fusion.step(frameTime(2), inputs.inertial(1, 2, 4e-4, unknown_velocity), inputs.visual(0, 2));
  EXPECT_TRUE(across.visual_step) << "so that the inertial filter learns the velocity";
}

TEST(HomographyFusion, BothLostBreaksTheChainAndStartsANewEpoch) {
  FusionInputs inputs(5);
  HomographyFusion fusion = makeFusion();
  fusion.step(frameTime(1), inputs.inertial(0, 1), inputs.visual(0, 1));
  const FusedHomography broken = fusion.step(frameTime(2), std::nullopt, std::nullopt);
  EXPECT_EQ(broken.source, FusionSource::kNone);
  EXPECT_EQ(broken.epoch, 1);
  EXPECT_EQ(broken.time_anchor, frameTime(2));
  const FusedHomography back = fusion.step(frameTime(3), inputs.inertial(2, 3), inputs.visual(2, 3));
  EXPECT_EQ(back.source, FusionSource::kFused);
  EXPECT_EQ(back.epoch, 1);
}

TEST(HomographyFusion, VisionThatSkippedFramesIsUsedWithItsOwnStart) {
  FusionInputs inputs(6);
  HomographyFusion fusion = makeFusion();
  for (int k = 1; k <= 4; ++k) fusion.step(frameTime(k), inputs.inertial(k - 1, k), std::nullopt);
  const FusedHomography out = fusion.step(frameTime(5), std::nullopt, inputs.visual(0, 5, 0.01));
  EXPECT_EQ(out.source, FusionSource::kVisual);
  EXPECT_EQ(out.time_previous, frameTime(4));
  EXPECT_LT(inputs.error(out.H_anchor, 0, 5), 0.1);
  const FusedHomography lost = fusion.step(frameTime(6), std::nullopt, inputs.visual(-1, 6));
  EXPECT_EQ(lost.source, FusionSource::kNone);  // starts at a frame that the fusion never had
}

TEST(HomographyFusion, TimeThatDoesNotMoveForwardIsRefusedNotThrown) {
  FusionInputs inputs(7);
  HomographyFusion fusion = makeFusion();
  fusion.step(frameTime(1), inputs.inertial(0, 1), inputs.visual(0, 1));
  for (const CameraTime time : {frameTime(1), frameTime(0), CameraTime::min()}) {
    FusedHomography out;
    EXPECT_NO_THROW(out = fusion.step(time, inputs.inertial(0, 1), inputs.visual(0, 1)));
    EXPECT_EQ(out.source, FusionSource::kNone);
    EXPECT_EQ(out.time_anchor, time);
  }
}

TEST(HomographyFusion, DamagedInputsCountAsAbsent) {
  FusionInputs inputs(8);
  HomographyFusion fusion = makeFusion();
  VisualInput nan = inputs.visual(0, 1);
  nan.H(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fusion.step(frameTime(1), inputs.inertial(0, 1), nan).source, FusionSource::kInertial);
  VisualInput negative = inputs.visual(1, 2);
  negative.covariance = -negative.covariance;
  EXPECT_EQ(fusion.step(frameTime(2), inputs.inertial(1, 2), negative).source, FusionSource::kInertial);
  VisualInput empty = inputs.visual(2, 3);
  empty.inliers = 0;
  EXPECT_EQ(fusion.step(frameTime(3), inputs.inertial(2, 3), empty).source, FusionSource::kInertial);
  VisualInput flat = inputs.visual(3, 4);
  flat.H.setZero();
  EXPECT_EQ(fusion.step(frameTime(4), inputs.inertial(3, 4), flat).source, FusionSource::kInertial);
}

}  // namespace
}  // namespace redbee::test
