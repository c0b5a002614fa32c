#include "redbee/geometry/homography.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "redbee/geometry/so3.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace redbee::test {
namespace {

PlaneMotion someMotion() {
  return {expSO3({0.02, -0.03, 0.05}), {0.3, -0.1, 0.2}, Eigen::Vector3d(0.1, 0.7, 0.7).normalized(), 8.0};
}

TEST(Homography, MapsPointsOfThePlaneAsTheRigidMotionDoes) {
  const PlaneMotion motion = someMotion();
  const Eigen::Matrix3d K = camera().K();
  const Eigen::Matrix3d H = planeHomography(K, motion);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> pixel(0, 480);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d x(pixel(random), pixel(random));
    const Eigen::Vector3d ray = K.inverse() * x.homogeneous();
    const Eigen::Vector3d X_a = ray * motion.h_a / motion.m_a.dot(ray);
    const Eigen::Vector3d X_b = motion.R_ba * X_a + motion.t_ba;
    EXPECT_LT((transfer(H, x) - (K * X_b).hnormalized()).norm(), 1e-9);
  }
}

TEST(Homography, GivesTheTranslationOnceRotationAndPlaneAreKnown) {
  const PlaneMotion truth = someMotion();
  PlaneMotion wrong = truth;
  wrong.t_ba.setZero();
  const Eigen::Matrix3d H = 3.7 * planeHomography(camera().K(), truth);
  EXPECT_LT((translationFromHomography(camera().K(), H, wrong) - truth.t_ba).norm(), 1e-12);
}

TEST(Homography, EveryJacobianMatchesDifferences) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d A = scaling.scale(planeHomography(camera().K(), someMotion()));
  const Eigen::Matrix3d B = A.transpose() / A(2, 2);
  const Eigen::Vector2d x(0.3, -0.6);

  const auto compose = composeJacobians(A, B);
  const auto by_left =
      numericJacobian<8, 8>([&](const Vector8d& d) { return toVector(fromVector(toVector(A) + d) * B); });
  const auto by_right =
      numericJacobian<8, 8>([&](const Vector8d& d) { return toVector(A * fromVector(toVector(B) + d)); });
  const auto inverse = numericJacobian<8, 8>(
      [&](const Vector8d& d) { return toVector(fromVector(toVector(A) + d).inverse()); });
  const auto by_entries =
      numericJacobian<2, 8>([&](const Vector8d& d) { return transfer(fromVector(toVector(A) + d), x); });
  const auto by_point = numericJacobian<2, 2>([&](const Eigen::Vector2d& d) { return transfer(A, x + d); });
  EXPECT_LT((compose.by_left - by_left).norm(), 1e-7);
  EXPECT_LT((compose.by_right - by_right).norm(), 1e-7);
  EXPECT_LT((inverseJacobian(A) - inverse).norm(), 1e-7);
  EXPECT_LT((transferJacobian(A, x) - by_entries).norm(), 1e-7);
  EXPECT_LT((transferJacobianPoint(A, x) - by_point).norm(), 1e-7);
}

TEST(Homography, PlaneMotionJacobiansMatchDifferences) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d K = scaling.T * camera().K();
  const PlaneMotion motion = someMotion();
  const auto moved = [&](auto change) {
    PlaneMotion other = motion;
    change(other);
    return toVector(planeHomography(K, other));
  };
  const auto J = planeHomographyJacobians(K, motion);
  const auto rotation = numericJacobian<8, 3>(
      [&](const Eigen::Vector3d& d) { return moved([&](PlaneMotion& m) { m.R_ba = expSO3(d) * m.R_ba; }); });
  const auto translation = numericJacobian<8, 3>(
      [&](const Eigen::Vector3d& d) { return moved([&](PlaneMotion& m) { m.t_ba += d; }); });
  const auto normal = numericJacobian<8, 3>(
      [&](const Eigen::Vector3d& d) { return moved([&](PlaneMotion& m) { m.m_a = expSO3(d) * m.m_a; }); });
  const auto height = numericJacobian<8, 1>(
      [&](const Eigen::Matrix<double, 1, 1>& d) { return moved([&](PlaneMotion& m) { m.h_a += d(0); }); });
  EXPECT_LT((J.by_rotation - rotation).norm(), 1e-8);
  EXPECT_LT((J.by_translation - translation).norm(), 1e-8);
  EXPECT_LT((J.by_normal - normal).norm(), 1e-8);
  EXPECT_LT((J.by_height - height).norm(), 1e-8);
}

/// By a ray of frame a that meets the plane, seen by each camera.
TEST(Homography, TheCamerasMayDiffer) {
  const PlaneMotion motion = someMotion();
  const CameraPair cameras{camera().K(), zoomed(camera().K(), 1.7)};
  const Eigen::Matrix3d H = planeHomography(cameras, motion);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(100, 300), {320, 240}, {600, 450}}) {
    const Eigen::Vector3d ray = camera().K_inverse() * pixel.homogeneous();
    const Eigen::Vector3d X_b = motion.R_ba * (motion.h_a / motion.m_a.dot(ray) * ray) + motion.t_ba;
    const Eigen::Vector2d seen = 1.7 * 500 * X_b.hnormalized() + Eigen::Vector2d(319.5, 239.5);
    EXPECT_LT((transfer(H, pixel) - seen).norm(), 1e-9);
  }
  EXPECT_LT((translationFromHomography(cameras, H, motion) - motion.t_ba).norm(), 1e-9);
}

TEST(Homography, ItsDerivativeByTheFocalLengthsMatchesDifferences) {
  const Eigen::Matrix3d T = ImageScaling(kWidth, kHeight).T;
  const auto scaled = [&](double log_a, double log_b) {
    const CameraPair cameras{T * zoomed(camera().K(), 1.2 * std::exp(log_a)),
                             T * zoomed(camera().K(), 0.8 * std::exp(log_b))};
    return std::pair(toVector(planeHomography(cameras, someMotion())),
                     planeHomographyJacobians(cameras, someMotion()));
  };
  constexpr double kStep = 1e-6;
  const auto J = scaled(0, 0).second;
  const Vector8d by_a = (scaled(kStep, 0).first - scaled(-kStep, 0).first) / (2 * kStep);
  const Vector8d by_b = (scaled(0, kStep).first - scaled(0, -kStep).first) / (2 * kStep);
  EXPECT_LT((J.by_zoom_a - by_a).norm(), 1e-8);
  EXPECT_LT((J.by_zoom_b - by_b).norm(), 1e-8);
}

TEST(Homography, ScalingIsUndoneByUnscaling) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d H = planeHomography(camera().K(), someMotion());
  EXPECT_LT((scaling.unscale(scaling.scale(H)) - H).norm(), 1e-9);
  EXPECT_LT(transfer(scaling.T, {319.5, 239.5}).norm(), 1e-12);
}

TEST(Homography, TransferErrorOfAShiftIsTheShift) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = 3;
  shift(1, 2) = 4;
  EXPECT_DOUBLE_EQ(meanTransferError(shift, Eigen::Matrix3d::Identity(), kWidth, kHeight), 5.0);
  EXPECT_TRUE(std::isinf(meanTransferError(-shift, Eigen::Matrix3d::Identity(), kWidth, kHeight)));
}

}  // namespace
}  // namespace redbee::test
