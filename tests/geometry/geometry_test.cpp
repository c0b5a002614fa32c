#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

Eigen::Matrix3d cameraMatrix() {
  Eigen::Matrix3d K;
  K << 500, 0, 319.5, 0, 500, 239.5, 0, 0, 1;
  return K;
}

PlaneMotion someMotion() {
  return {expSO3({0.02, -0.03, 0.05}), {0.3, -0.1, 0.2}, Eigen::Vector3d(0.1, 0.7, 0.7).normalized(), 8.0};
}

/// Central differences of a function of n variables around zero.
template <int kRows, int kCols, typename Function>
Eigen::Matrix<double, kRows, kCols> numericJacobian(const Function& f, double step = 1e-6) {
  Eigen::Matrix<double, kRows, kCols> J;
  for (int i = 0; i < kCols; ++i) {
    Eigen::Matrix<double, kCols, 1> d = Eigen::Matrix<double, kCols, 1>::Zero();
    d(i) = step;
    J.col(i) = (f(d) - f(-d)) / (2 * step);
  }
  return J;
}

TEST(Rotation, ExpAndLogAreInversesForSmallAndLargeAngles) {
  for (const double angle : {0.0, 1e-9, 1e-5, 0.1, 1.5, 3.1}) {
    const Eigen::Vector3d phi = angle * Eigen::Vector3d(1, -2, 0.5).normalized();
    EXPECT_LT((logSO3(expSO3(phi)) - phi).norm(), 1e-9) << angle;
    EXPECT_TRUE(isRotation(expSO3(phi), 1e-12));
  }
}

TEST(Rotation, ExpAgreesWithEigen) {
  const Eigen::Vector3d phi(0.3, -0.2, 0.9);
  const Eigen::Matrix3d expected = Eigen::AngleAxisd(phi.norm(), phi.normalized()).toRotationMatrix();
  EXPECT_LT((expSO3(phi) - expected).norm(), 1e-14);
}

TEST(Rotation, RightJacobianMatchesDifferences) {
  const Eigen::Vector3d phi(0.3, -0.2, 0.9);
  const auto numeric = numericJacobian<3, 3>(
      [&](const Eigen::Vector3d& d) { return logSO3(expSO3(phi).transpose() * expSO3(phi + d)); });
  EXPECT_LT((rightJacobianSO3(phi) - numeric).norm(), 1e-8);
}

TEST(Rotation, NearestRotationUndoesANonRigidDisturbance) {
  const Eigen::Matrix3d R = expSO3({0.3, -0.2, 0.9});
  EXPECT_LT((nearestRotation(1.7 * R) - R).norm(), 1e-12);
  EXPECT_FALSE(isRotation(1.001 * R));
  EXPECT_FALSE(isRotation(-R));
}

TEST(Camera, UndistortInvertsDistortOverTheImage) {
  // EuRoC's camera, whose distortion moves the corners by more than 100 px.
  const Camera camera({752,
                       480,
                       458.654,
                       457.296,
                       367.215,
                       248.375,
                       {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}});
  for (int v = 0; v < 480; v += 60) {
    for (int u = 0; u < 752; u += 60) {
      const Eigen::Vector2d raw(u, v);
      EXPECT_LT((camera.distort(camera.undistort(raw)) - raw).norm(), 1e-9) << u << ' ' << v;
    }
  }
}

TEST(Homography, MapsPointsOfThePlaneAsTheRigidMotionDoes) {
  const PlaneMotion motion = someMotion();
  const Eigen::Matrix3d K = cameraMatrix();
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

TEST(Homography, TellsTheTranslationOnceRotationAndPlaneAreKnown) {
  const PlaneMotion truth = someMotion();
  PlaneMotion wrong = truth;
  wrong.t_ba.setZero();
  const Eigen::Matrix3d H = 3.7 * planeHomography(cameraMatrix(), truth);
  EXPECT_LT((translationFromHomography(cameraMatrix(), H, wrong) - truth.t_ba).norm(), 1e-12);
}

TEST(Homography, EveryJacobianMatchesDifferences) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d A = scaling.scale(planeHomography(cameraMatrix(), someMotion()));
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
  const Eigen::Matrix3d K = scaling.T * cameraMatrix();
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

TEST(Homography, ScalingIsUndoneByUnscaling) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d H = planeHomography(cameraMatrix(), someMotion());
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
}  // namespace redbee
