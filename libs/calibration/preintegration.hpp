// IMU samples between two times, integrated in the first one's frame (Forster et al., "On-Manifold
// Preintegration", 2017).
//
//     R_b = R_a R(b_g)
//     v_b = v_a + g dt + R_a v(b_g, b_a)
//     p_b = p_a + v_a dt + g dt^2 / 2 + R_a p(b_g, b_a)
//
// R, v, p depend on the biases, to first order around those of the integration.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/imu_history.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee::calibration {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

struct Bias {
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   ///< rad/s in I
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  ///< m/s^2 in I
};

struct Preintegration {
  double dt_s = 0;
  Bias bias;  ///< subtracted from the samples
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m
  /// Derivatives: of R's right perturbation by the gyro bias, of v and p by both.
  Eigen::Matrix3d R_by_gyro = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d v_by_gyro = Eigen::Matrix3d::Zero(), v_by_accel = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d p_by_gyro = Eigen::Matrix3d::Zero(), p_by_accel = Eigen::Matrix3d::Zero();
  Matrix9d covariance = Matrix9d::Zero();  ///< of (right perturbation of R [rad], v, p), white noise only
};

/// Precondition: imu covers [from, to], from < to.
Preintegration preintegrate(const ImuHistory& imu, double from_s, double to_s, const Bias& bias,
                            const ImuNoise& noise);

}  // namespace redbee::calibration
