// Simulated visual measurements of an exact homography, with correct covariance.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>

#include "redbee/inertial/inertial_filter.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

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

}  // namespace redbee::test
