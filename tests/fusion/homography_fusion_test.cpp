#include "redbee/fusion/homography_fusion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <iostream>
#include <limits>
#include <random>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int64_t kPeriod = 41'667;  // us

int64_t frameTime(int k) { return 1'000'000 + k * kPeriod; }

Eigen::Matrix3d translation(double x_px, double y_px = 0) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = x_px;
  H(1, 2) = y_px;
  return H;
}

/// Frames over a plane, exact homographies between any two of them, and noisy measurements of those.
class Scene {
 public:
  explicit Scene(unsigned seed)
      : trajectory_(simulation::Trajectory::ordinary(seed, 8)), random_(seed), scaling_(kWidth, kHeight) {
    Eigen::Matrix3d level;
    level << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    extrinsics_.R_CI = expSO3({0.7, 0, 0}) * level;
    K_ << 500, 0, 319.5, 0, 500, 239.5, 0, 0, 1;
  }

  Eigen::Matrix3d exact(int a, int b) const {
    return planeHomography(
        K_, simulation::exactMotion(trajectory_, extrinsics_, a * kPeriod * 1e-6, b * kPeriod * 1e-6));
  }

  /// What an IMU gets wrong: rotation and translation, hence a covariance of another shape than vision's.
  InertialInput inertial(int a, int b, double rotation_sigma = 4e-4, double translation_sigma = 6e-3) {
    PlaneMotion motion =
        simulation::exactMotion(trajectory_, extrinsics_, a * kPeriod * 1e-6, b * kPeriod * 1e-6);
    const PlaneHomographyJacobians J = planeHomographyJacobians(scaling_.T * K_, motion);
    const double rotation_variance = rotation_sigma * rotation_sigma;
    const double translation_variance = translation_sigma * translation_sigma;
    const Matrix8d covariance = rotation_variance * J.by_rotation * J.by_rotation.transpose() +
                                translation_variance * J.by_translation * J.by_translation.transpose() +
                                1e-12 * Matrix8d::Identity();
    return {frameTime(a), disturbed(exact(a, b), covariance), covariance};
  }

  /// What tracking gets wrong: pixel noise on `points` points of the lower left quarter, extrapolated to the
  /// rest.
  VisualInput visual(int a, int b, double sigma_px = 0.4, int inliers = 300, int outliers = 100) {
    const Eigen::Matrix3d H = scaling_.scale(exact(a, b));
    Matrix8d information = Matrix8d::Zero();
    for (int v = kHeight / 2; v < kHeight; v += 32) {
      for (int u = 16; u < kWidth / 2; u += 32) {
        const auto J = transferJacobian(H, (scaling_.T * Eigen::Vector3d(u, v, 1)).head<2>());
        information += J.transpose() * J;
      }
    }
    const double sigma = sigma_px / scaling_.unit_px;
    const double ratio = 1.0 + static_cast<double>(outliers) / inliers;
    const Matrix8d inverse = information.inverse();
    const Matrix8d covariance = sigma * sigma * 0.5 * (inverse + inverse.transpose());
    // The message's covariance is that of the inliers; outliers add to it as equation 7 says.
    return {frameTime(a), disturbed(exact(a, b), ratio * covariance), covariance, inliers, outliers};
  }

  double error(const Eigen::Matrix3d& H, int a, int b) const {
    return meanTransferError(H, exact(a, b), kWidth, kHeight);
  }

  double normalisedErrorSquared(const FusedHomography& out, int a, int b) const {
    const Vector8d error = toVector(scaling_.scale(out.H_step)) - toVector(scaling_.scale(exact(a, b)));
    return error.dot(out.covariance_step.ldlt().solve(error));
  }

 private:
  Eigen::Matrix3d disturbed(const Eigen::Matrix3d& H, const Matrix8d& covariance) {
    std::normal_distribution<double> normal;
    const Eigen::SelfAdjointEigenSolver<Matrix8d> axes(covariance);
    Vector8d z;
    for (int i = 0; i < 8; ++i) z(i) = std::sqrt(std::max(0.0, axes.eigenvalues()(i))) * normal(random_);
    return scaling_.unscale(fromVector(toVector(scaling_.scale(H)) + axes.eigenvectors() * z));
  }

  simulation::Trajectory trajectory_;
  InertialExtrinsics extrinsics_;
  std::mt19937 random_;
  ImageScaling scaling_;
  Eigen::Matrix3d K_;
};

/// The simulated covariances are the true ones: nothing is to be added for relief.
FusionParameters honestNoise() {
  FusionParameters parameters;
  parameters.visual_inflation = 1;
  return parameters;
}

HomographyFusion makeFusion(const FusionParameters& parameters = honestNoise()) {
  HomographyFusion fusion(kWidth, kHeight, parameters);
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  return fusion;
}

void expectCovariance(const Matrix8d& P) {
  EXPECT_TRUE(P.isApprox(P.transpose(), 1e-12) || P.isZero());
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix8d>(P).eigenvalues().minCoeff(), -1e-12 * (1 + P.trace()));
}

TEST(HomographyFusion, IsBetterThanEitherSourceAlone) {
  double inertial_sum = 0;
  double visual_sum = 0;
  double fused_sum = 0;
  constexpr int kFrames = 240;
  Scene scene(1);
  HomographyFusion fusion = makeFusion();
  for (int k = 1; k <= kFrames; ++k) {
    const InertialInput inertial = scene.inertial(k - 1, k);
    const VisualInput visual = scene.visual(k - 1, k);
    const FusedHomography out = fusion.step(frameTime(k), inertial, visual);
    inertial_sum += scene.error(inertial.H, k - 1, k);
    visual_sum += scene.error(visual.H, k - 1, k);
    fused_sum += scene.error(out.H_step, k - 1, k);
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
    Scene scene(run);
    HomographyFusion fusion = makeFusion();
    FusedHomography out;
    for (int k = 1; k <= kFrames; ++k) {
      out = fusion.step(frameTime(k), scene.inertial(k - 1, k), scene.visual(k - 1, k));
    }
    sum += scene.normalisedErrorSquared(out, kFrames - 1, kFrames);
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
  FusionParameters parameters = honestNoise();
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

TEST(HomographyFusion, AGrossVisualErrorIsRefusedAndLaterBelieved) {
  Scene scene(2);
  FusionParameters parameters = honestNoise();
  HomographyFusion fusion = makeFusion(parameters);
  FusedHomography out;
  for (int k = 1; k <= parameters.max_gated_in_a_row; ++k) {
    VisualInput wrong = scene.visual(k - 1, k);
    wrong.H = translation(60) * wrong.H;
    out = fusion.step(frameTime(k), scene.inertial(k - 1, k), wrong);
    EXPECT_EQ(out.source, FusionSource::kInertial);
    EXPECT_GT(out.test_ratio, 1);
    EXPECT_FALSE(out.visual_accepted);
    EXPECT_LT(scene.error(out.H_step, k - 1, k), 5);
  }
  const int32_t epoch = out.epoch;
  const int k = parameters.max_gated_in_a_row + 1;
  VisualInput insistent = scene.visual(k - 1, k);
  insistent.H = translation(60) * insistent.H;
  out = fusion.step(frameTime(k), scene.inertial(k - 1, k), insistent);
  EXPECT_EQ(out.source, FusionSource::kVisual);
  EXPECT_EQ(out.epoch, epoch + 1);
}

TEST(HomographyFusion, EpochsRenewTheAnchorAndComposeWithin) {
  Scene scene(3);
  HomographyFusion fusion = makeFusion();
  int32_t epoch = 0;
  int anchor = 0;
  for (int k = 1; k <= 240; ++k) {
    const FusedHomography out = fusion.step(frameTime(k), scene.inertial(k - 1, k), scene.visual(k - 1, k));
    ASSERT_NE(out.source, FusionSource::kNone) << k;
    if (out.epoch != epoch) {
      EXPECT_EQ(out.epoch, epoch + 1);
      EXPECT_EQ(out.utime_anchor, frameTime(k));
      EXPECT_TRUE(out.H_anchor.isIdentity());
      EXPECT_LT(scene.error(out.H_step, k - 1, k), 3);
      epoch = out.epoch;
      anchor = k;
    }
    EXPECT_EQ(out.utime_anchor, frameTime(anchor));
  }
  EXPECT_GE(epoch, 1);
}

TEST(HomographyFusion, EitherSourceMayBeLostForASecondAndComeBack) {
  for (const bool vision_lost : {true, false}) {
    Scene scene(4);
    HomographyFusion fusion = makeFusion();
    for (int k = 1; k <= 96; ++k) {
      const bool lost = k > 36 && k <= 60;
      std::optional<InertialInput> inertial = scene.inertial(k - 1, k);
      std::optional<VisualInput> visual = scene.visual(k - 1, k);
      if (lost && vision_lost) visual.reset();
      if (lost && !vision_lost) inertial.reset();
      const FusedHomography out = fusion.step(frameTime(k), inertial, visual);
      const FusionSource alone = vision_lost ? FusionSource::kInertial : FusionSource::kVisual;
      EXPECT_EQ(out.source, lost ? alone : FusionSource::kFused) << k;
      EXPECT_LT(scene.error(out.H_step, k - 1, k), 5) << k;  // no jump, on the way out or back
    }
  }
}

TEST(HomographyFusion, AnInertialStepThatKnowsNoVelocityIsNoHomographyByItself) {
  Scene scene(4);
  HomographyFusion fusion(kWidth, kHeight, {});
  const double unknown_velocity = 3.0 * kPeriod * 1e-6;  // m in a frame, at 3 m/s
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  const auto alone = fusion.step(frameTime(1), scene.inertial(0, 1, 4e-4, unknown_velocity), std::nullopt);
  EXPECT_EQ(alone.source, FusionSource::kNone) << "its covariance says that it may be off by many pixels";
  const auto both =
      fusion.step(frameTime(2), scene.inertial(1, 2, 4e-4, unknown_velocity), scene.visual(1, 2));
  EXPECT_EQ(both.source, FusionSource::kFused) << "it still knows the rotation, and vision knows the rest";
  const auto known = fusion.step(frameTime(3), scene.inertial(2, 3), std::nullopt);
  EXPECT_EQ(known.source, FusionSource::kInertial);
}

TEST(HomographyFusion, BothLostBreaksTheChainAndStartsANewEpoch) {
  Scene scene(5);
  HomographyFusion fusion = makeFusion();
  fusion.step(frameTime(1), scene.inertial(0, 1), scene.visual(0, 1));
  const FusedHomography broken = fusion.step(frameTime(2), std::nullopt, std::nullopt);
  EXPECT_EQ(broken.source, FusionSource::kNone);
  EXPECT_EQ(broken.epoch, 1);
  EXPECT_EQ(broken.utime_anchor, frameTime(2));
  const FusedHomography back = fusion.step(frameTime(3), scene.inertial(2, 3), scene.visual(2, 3));
  EXPECT_EQ(back.source, FusionSource::kFused);
  EXPECT_EQ(back.epoch, 1);
}

TEST(HomographyFusion, VisionThatSkippedFramesIsUsedWithItsOwnStart) {
  Scene scene(6);
  HomographyFusion fusion = makeFusion();
  for (int k = 1; k <= 4; ++k) fusion.step(frameTime(k), scene.inertial(k - 1, k), std::nullopt);
  const FusedHomography out = fusion.step(frameTime(5), std::nullopt, scene.visual(0, 5, 0.01));
  EXPECT_EQ(out.source, FusionSource::kVisual);
  EXPECT_EQ(out.utime_previous, frameTime(4));
  EXPECT_LT(scene.error(out.H_anchor, 0, 5), 0.1);
  const FusedHomography lost = fusion.step(frameTime(6), std::nullopt, scene.visual(-1, 6));
  EXPECT_EQ(lost.source, FusionSource::kNone);  // starts at a frame that the fusion never saw
}

TEST(HomographyFusion, TimeThatDoesNotMoveForwardIsRefusedNotThrown) {
  Scene scene(7);
  HomographyFusion fusion = makeFusion();
  fusion.step(frameTime(1), scene.inertial(0, 1), scene.visual(0, 1));
  for (const int64_t utime : {frameTime(1), frameTime(0), std::numeric_limits<int64_t>::min()}) {
    FusedHomography out;
    EXPECT_NO_THROW(out = fusion.step(utime, scene.inertial(0, 1), scene.visual(0, 1)));
    EXPECT_EQ(out.source, FusionSource::kNone);
    EXPECT_EQ(out.utime_anchor, utime);
  }
}

TEST(HomographyFusion, DamagedInputsCountAsAbsent) {
  Scene scene(8);
  HomographyFusion fusion = makeFusion();
  VisualInput nan = scene.visual(0, 1);
  nan.H(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fusion.step(frameTime(1), scene.inertial(0, 1), nan).source, FusionSource::kInertial);
  VisualInput negative = scene.visual(1, 2);
  negative.covariance = -negative.covariance;
  EXPECT_EQ(fusion.step(frameTime(2), scene.inertial(1, 2), negative).source, FusionSource::kInertial);
  VisualInput empty = scene.visual(2, 3);
  empty.inliers = 0;
  EXPECT_EQ(fusion.step(frameTime(3), scene.inertial(2, 3), empty).source, FusionSource::kInertial);
  VisualInput flat = scene.visual(3, 4);
  flat.H.setZero();
  EXPECT_EQ(fusion.step(frameTime(4), scene.inertial(3, 4), flat).source, FusionSource::kInertial);
}

}  // namespace
}  // namespace redbee
