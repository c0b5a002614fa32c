// Scale and misalignment of a gyro's axes, from the rotation rates of camera and gyro:
//
//     R_CI' w_C = (I + S) (w_I - b)        S: symmetric; its antisymmetric part is a rotation of the mounting
//
// A wrong focal length looks like a scale about the camera's x and y axes: what a calibration of the lens
// leaves is part of the covariance, so that a scale about both has to be larger than a misalignment to count.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "redbee/calibration/hand_eye.hpp"

namespace redbee::calibration {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct GyroShape {
  Vector6d shape = Vector6d::Zero();  ///< of S: xx yy zz, xy xz yz
  /// Infinite on its diagonal where the rotation does not show S.
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d lens_covariance = Matrix6d::Zero();  ///< part of it: what a calibration of the lens leaves

  /// I + S: turns measured rates, their bias taken off, into true ones.
  Eigen::Matrix3d correction() const;
  double worstSigma() const;  ///< along the least certain direction
  /// Whether axes without an error are out of the question, by all entries together.
  bool isSignificant() const;
};

/// At least 72 pairs in order of time, and the closed form's solution of them.
GyroShape estimateGyroShape(const std::vector<RatePair>& pairs, const HandEye& solution);

}  // namespace redbee::calibration
