// Scale and misalignment of a gyro's axes, from the rotation rates of camera and gyro:
//
//     R_CI' w_C = (I + S) (w_I - b)        S: symmetric; its antisymmetric part is a rotation of the mounting
//
// A wrong focal length looks like a scale about the camera's x and y axes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "redbee/calibration/hand_eye.hpp"

namespace redbee::calibration {

using Vector6d = Eigen::Matrix<double, 6, 1>;

struct GyroShape {
  Vector6d shape = Vector6d::Zero();  ///< of S: xx yy zz, xy xz yz
  Vector6d sigma = Vector6d::Zero();  ///< infinity where the rotation does not show the entry
  double worst_sigma = 0;             ///< along the least certain direction

  /// I + S: turns measured rates, their bias taken off, into true ones.
  Eigen::Matrix3d correction() const;
  /// Whether an entry is beyond its deviation and beyond what a focal length's ordinary error looks like.
  bool isSignificant() const {
    constexpr double kOrdinary = 0.005;
    return (shape.array().abs() > (3 * sigma.array()).max(kOrdinary)).any();
  }
};

/// At least twelve pairs, and the closed form's solution of them.
GyroShape estimateGyroShape(const std::vector<RatePair>& pairs, const HandEye& solution);

}  // namespace redbee::calibration
