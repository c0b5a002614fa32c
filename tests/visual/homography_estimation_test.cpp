#include "redbee/visual/homography_estimation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <iostream>

#include "redbee/visual/front_plane_estimator.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

using simulation::SimulatedTracks;
using simulation::simulateTracks;
using simulation::TrackOrigin;

Eigen::Matrix3d ground() { return groundHomography({5, 8, -4}, {0.5, 0.2, 3}); }

/// An upright wall 12 m ahead under the same motion.
Eigen::Matrix3d wall() {
  PlaneMotion motion = groundMotion({5, 8, -4}, {0.5, 0.2, 3});
  motion.m_a = {0, -std::sin(40 * M_PI / 180), std::cos(40 * M_PI / 180)};
  motion.h_a = 12;
  return planeHomography(camera().K(), motion);
}

SimulatedTracks oneplane(double noise_px, double outliers, unsigned seed) {
  return simulateTracks(ground(), ground(), 0, noise_px, outliers, {}, seed);
}

TEST(HomographyEstimation, GroundWithin0p1PxWith40PercentOutliers) {
  double worst = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PointTracks tracks = toTracks(oneplane(0.3, 0.4, seed));
    const auto estimate = estimateHomography(tracks, kWidth, kHeight, {});
    ASSERT_TRUE(estimate);
    worst = std::max(worst, meanTransferError(estimate->H, ground(), kWidth, kHeight));
  }
  std::cout << "worst mean transfer error of 20 runs: " << worst << " px\n";
  RecordProperty("worst_mean_transfer_error_px", std::to_string(worst));
  EXPECT_LT(worst, 0.1);
}

TEST(HomographyEstimation, InlierFlagsAreRight) {
  int truly_in = 0, flagged_in = 0, truly_out = 0, flagged_out = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const SimulatedTracks simulated = oneplane(0.25, 0.4, seed);
    const auto estimate = estimateHomography(toTracks(simulated), kWidth, kHeight, {});
    ASSERT_TRUE(estimate);
    ASSERT_EQ(estimate->inlier.size(), simulated.origin.size());
    for (std::size_t i = 0; i < simulated.origin.size(); ++i) {
      const bool outlier = simulated.origin[i] == TrackOrigin::kOutlier;
      (outlier ? truly_out : truly_in) += 1;
      if (outlier) flagged_out += estimate->inlier[i] ? 0 : 1;
      if (!outlier) flagged_in += estimate->inlier[i] ? 1 : 0;
    }
  }
  std::cout << "inliers flagged " << flagged_in << " of " << truly_in << ", outliers " << flagged_out
            << " of " << truly_out << "\n";
  EXPECT_GE(flagged_in, 0.99 * truly_in);
  EXPECT_GE(flagged_out, 0.99 * truly_out);
}

TEST(HomographyEstimation, CovarianceIsNotOptimisticAndNotVague) {
  // Independent errors: the estimate is more accurate than its covariance, by the factor that it keeps
  // for the correlation of real tracking errors, and never worse.
  constexpr int kRuns = 200;
  const ImageScaling scaling(kWidth, kHeight);
  double nees = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const auto estimate = estimateHomography(toTracks(oneplane(0.25, 0.2, seed)), kWidth, kHeight, {});
    ASSERT_TRUE(estimate);
    const Vector8d error = toVector(scaling.scale(estimate->H)) - toVector(scaling.scale(ground()));
    nees += error.dot(estimate->covariance.ldlt().solve(error)) / kRuns;
  }
  const double nees_of_independent = nees * kCorrelationInflation;
  // Mean of 200 chi-square values of 8 degrees of freedom: 8 within 2.6 of its deviation sqrt(16 / 200).
  std::cout << "mean NEES " << nees << ", with the inflation taken out " << nees_of_independent
            << " (8 expected)\n";
  EXPECT_NEAR(nees_of_independent, 8.0, 0.1 * 8.0 + 2.6 * std::sqrt(16.0 / kRuns));
}

TEST(HomographyEstimation, PredictionPicksTheGroundWhereAWallHasMostPoints) {
  const PointTracks tracks = toTracks(simulateTracks(ground(), wall(), 0.7, 0.25, 0.1, {}, 3));
  const ImageScaling scaling(kWidth, kHeight);
  // 0.03 degrees about each axis and 5 % of the translation.
  PlaneMotion motion = groundMotion({5, 8, -4}, {0.5, 0.2, 3});
  const auto jacobians = planeHomographyJacobians(camera().K(), motion);
  const double rotation = 0.03 * M_PI / 180;
  Eigen::Matrix<double, 8, 4> directions;
  directions << rotation * jacobians.by_rotation, 0.05 * jacobians.by_translation * motion.t_ba;
  Eigen::Matrix3d prediction = fromVector(toVector(ground()) + directions * Eigen::Vector4d(1, -1, 1, 1));
  // To scaled entries, column by column of the pixel covariance's root.
  Eigen::Matrix<double, 8, 4> root;
  for (int i = 0; i < 4; ++i) {
    root.col(i) = toVector(scaling.scale(fromVector(toVector(ground()) + directions.col(i)))) -
                  toVector(scaling.scale(ground()));
  }
  const auto most = estimateHomography(tracks, kWidth, kHeight, {});
  const auto near = estimateHomographyNear(tracks, kWidth, kHeight, prediction, root * root.transpose(), {});
  ASSERT_TRUE(most);
  ASSERT_TRUE(near);
  // The ground's points fill the left 30 % of the view; it is evaluated there.
  const double error = meanTransferError(near->H, ground(), kWidth * 3 / 10, kHeight);
  std::cout << "ground error where it is visible: " << error << " px, most inliers' "
            << meanTransferError(most->H, ground(), kWidth * 3 / 10, kHeight) << " px\n";
  EXPECT_LT(meanTransferError(most->H, wall(), kWidth, kHeight), 0.3);
  EXPECT_LT(error, 0.1);
}

TEST(HomographyEstimation, PredictionThatContradictsThePointsFindsNothing) {
  const PointTracks tracks = toTracks(oneplane(0.25, 0.1, 5));
  Eigen::Matrix3d wrong = ground();
  wrong(0, 2) += 15;
  const Matrix8d sure = Matrix8d::Identity() * 1e-8;
  EXPECT_FALSE(estimateHomographyNear(tracks, kWidth, kHeight, wrong, sure, {}));
}

TEST(FrontPlane, IsFoundBesideTheGroundAndNotWithoutOne) {
  const PointTracks two = toTracks(simulateTracks(ground(), wall(), 0.3, 0.25, 0.1, {}, 7));
  const auto front = FrontPlaneEstimator(kWidth, kHeight, {}).estimate(two, ground());
  ASSERT_TRUE(front);
  int right = 0;
  for (std::size_t i = 0; i < front->inlier.size(); ++i)
    right += front->inlier[i] && two.previous[i].x > 0.65 * kWidth;
  std::cout << "front plane: " << front->inliers << " inliers, " << right << " of them on the wall\n";
  EXPECT_GT(right, 0.95 * front->inliers);

  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PointTracks one = toTracks(oneplane(0.25, 0.3, seed));
    EXPECT_FALSE(FrontPlaneEstimator(kWidth, kHeight, {}).estimate(one, ground())) << "seed " << seed;
  }
}

TEST(HomographyEstimation, SameInputSameOutput) {
  const PointTracks tracks = toTracks(oneplane(0.3, 0.5, 11));
  const auto a = estimateHomography(tracks, kWidth, kHeight, {});
  const auto b = estimateHomography(tracks, kWidth, kHeight, {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->H, b->H);
  EXPECT_EQ(a->covariance, b->covariance);
  EXPECT_EQ(a->inlier, b->inlier);
}

TEST(HomographyEstimation, NoPlaneInNoiseOrInTooFewOrCollinearPoints) {
  EXPECT_FALSE(estimateHomography({}, kWidth, kHeight, {}));
  EXPECT_FALSE(estimateHomography(toTracks(oneplane(0.3, 1.0, 2)), kWidth, kHeight, {}));
  PointTracks line;
  for (int i = 0; i < 200; ++i) {
    line.previous.emplace_back(3.F * i, 2.F * i);
    line.current.emplace_back(3.F * i + 4, 2.F * i);
  }
  EXPECT_FALSE(estimateHomography(line, kWidth, kHeight, {}));
  PointTracks unequal = line;
  unequal.current.pop_back();
  EXPECT_THROW(estimateHomography(unequal, kWidth, kHeight, {}), std::invalid_argument);
}

}  // namespace
}  // namespace redbee::test
