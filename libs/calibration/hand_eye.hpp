// The rotation between camera and IMU, and the gyro's bias, in closed form.
//
// Between two frames both bodies turn by the same angle, each about its own axes:
//
//     w_C = R_CI (w_I - b) = R_CI w_I + c        w: mean angular rate, c = -R_CI b
//
// Least squares over many pairs: R_CI is the rotation that aligns the rates after their means are taken out
// (Kabsch 1976), c what remains of the means. Pairs are weighted by their residuals (Cauchy), so that wrong
// homographies have no influence.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee::calibration {

/// Mean angular rates over one interval [rad/s], of the camera in C and of the IMU in I.
struct RatePair {
  Eigen::Vector3d camera;
  Eigen::Vector3d imu;
};

struct HandEye {
  Eigen::Matrix3d R_CI = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();  ///< rad/s in I
  /// Root-mean-square rate about the principal axes of the rotation [rad/s], descending, means taken out:
  /// square roots of the singular values of the rates' cross-covariance. If the second is zero, the rotation
  /// is about one axis only and R_CI is not determined.
  Eigen::Vector3d excitation = Eigen::Vector3d::Zero();
  double residual = 0;  ///< rad/s, root of the weighted mean squared residual, per axis
  double cost = 0;      ///< mean robust cost [rad^2/s^2]; comparable for equal `scale`
  Eigen::Vector3d sigma =
      Eigen::Vector3d::Zero();  ///< rad, of R_CI about its principal axes, ascending excitation last
};

/// At least three pairs. `scale` [rad/s]: residual at which a pair counts half; 0 takes it from the
/// residuals' median.
HandEye solveHandEye(const std::vector<RatePair>& pairs, double scale = 0);

/// Residual of one pair under a solution [rad/s], in C.
Eigen::Vector3d handEyeResidual(const RatePair& pair, const HandEye& solution);

}  // namespace redbee::calibration
