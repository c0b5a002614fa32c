// A simulated flight for the inertial filter: what it is fed, and the truth beside it.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::testing {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kFrameRate = 24;
constexpr int64_t kStart = 1'000'000'000;  // us

inline Camera testCamera() { return Camera({kWidth, kHeight, 500, 500, 319.5, 239.5, {}}); }

/// Consumer grade: 0.005 deg/s/sqrt(Hz), 200 ug/sqrt(Hz).
inline ImuNoise consumerNoise() { return {8.7e-5, 1.96e-3, 2e-5, 4e-4}; }

/// Camera looks along IMU x, `pitch_deg` below the horizon; 5 cm from the IMU.
inline InertialExtrinsics testExtrinsics(double height_m, double pitch_deg = 40) {
  Eigen::Matrix3d level;
  level << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  InertialExtrinsics extrinsics;
  extrinsics.R_CI = expSO3({pitch_deg * M_PI / 180, 0, 0}) * level;
  extrinsics.p_IC = {0.04, -0.02, 0.02};
  extrinsics.timeshift_s = 0.006;
  extrinsics.start_height_m = height_m;
  return extrinsics;
}

inline int64_t frameTime(int k) { return kStart + static_cast<int64_t>(std::llround(k * 1e6 / kFrameRate)); }

/// What the camera's clock shows, as seconds of the trajectory (the IMU's clock).
inline double trajectoryTime(int64_t frame_utime, const InertialExtrinsics& extrinsics) {
  return static_cast<double>(frame_utime - kStart) * 1e-6 + extrinsics.timeshift_s;
}

inline Eigen::Vector3d randomVector(std::mt19937& random, double sigma) {
  std::normal_distribution<double> normal(0, sigma);
  return {normal(random), normal(random), normal(random)};
}

/// Vision with independent pixel noise on a grid of points: least squares, linearised at the truth (where it
/// is exact to second order in the noise).
inline HomographyObservation noisyHomography(const Eigen::Matrix3d& exact, double sigma_px,
                                             std::mt19937& random) {
  const ImageScaling scaling(kWidth, kHeight);
  const Eigen::Matrix3d H = scaling.scale(exact);
  const double sigma = sigma_px / scaling.unit_px;
  std::normal_distribution<double> normal(0, sigma);
  Matrix8d information = Matrix8d::Zero();
  Vector8d gradient = Vector8d::Zero();
  for (int v = 40; v < kHeight; v += 80) {
    for (int u = 40; u < kWidth; u += 80) {
      const Eigen::Vector2d x = (scaling.T * Eigen::Vector3d(u, v, 1)).head<2>();
      const auto J = transferJacobian(H, x);
      information += J.transpose() * J;
      gradient += J.transpose() * Eigen::Vector2d(normal(random), normal(random));
    }
  }
  const Matrix8d inverse = information.inverse();
  HomographyObservation observation;
  observation.H = scaling.unscale(fromVector(toVector(H) + inverse * gradient));
  observation.covariance = sigma * sigma * inverse;
  return observation;
}

/// Squared normalised error of a homography against its covariance.
inline double normalisedErrorSquared(const Eigen::Matrix3d& H, const Matrix8d& covariance,
                                     const Eigen::Matrix3d& exact) {
  const ImageScaling scaling(kWidth, kHeight);
  const Vector8d error = toVector(scaling.scale(H)) - toVector(scaling.scale(exact));
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace redbee::testing
