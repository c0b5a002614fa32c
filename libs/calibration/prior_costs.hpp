// Priors, each with its standard deviation. They keep the problem well-posed if a parameter is not
// observable; a parameter whose deviation they determine is not reported as found.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/camera_motion.hpp"

namespace redbee::calibration {

/// r = (x - x_0) / sigma, for a parameter of N entries, or for the first N of more.
template <int N>
struct VectorPriorCost {
  Eigen::Matrix<double, N, 1> expected;
  double sigma;

  static constexpr int kResiduals = N;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    for (int i = 0; i < N; ++i) residual[i] = (x[i] - T(expected(i))) / T(sigma);
    return true;
  }
};

/// r = log(q q_0^-1) / sigma.
struct RotationPriorCost {
  Eigen::Quaterniond expected;
  double sigma_rad;

  static constexpr int kResiduals = 3;

  template <typename T>
  bool operator()(const T* q, T* residual) const {
    Eigen::Map<Vector3T<T>> r(residual);
    r = smallRotationVector<T>(Eigen::Map<const Eigen::Quaternion<T>>(q) * expected.conjugate().cast<T>()) /
        T(sigma_rad);
    return true;
  }
};

/// Fixes the gauge: yaw about G's z is not observable and is kept at its initial value: r = log(q q_0^-1)_z /
/// sigma.
struct YawGaugeCost {
  Eigen::Quaterniond start;
  double sigma_rad;

  static constexpr int kResiduals = 1;

  template <typename T>
  bool operator()(const T* q, T* residual) const {
    residual[0] =
        smallRotationVector<T>(Eigen::Map<const Eigen::Quaternion<T>>(q) * start.conjugate().cast<T>()).z() /
        T(sigma_rad);
    return true;
  }
};

/// Random walk of a bias from one stretch to the next: r = (b_next - b) / sigma, sigma = random walk density
/// * sqrt(duration).
struct BiasWalkCost {
  double sigma;

  static constexpr int kResiduals = 3;

  template <typename T>
  bool operator()(const T* b, const T* b_next, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (b_next[i] - b[i]) / T(sigma);
    return true;
  }
};

}  // namespace redbee::calibration
