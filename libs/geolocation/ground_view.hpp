// Where the camera was and how it was turned when a frame was exposed.
#pragma once

#include <Eigen/Core>

namespace redbee {

/// Frame E: east, north, up. Positions are metres east and north in the local frame (local_frame.hpp).
struct GroundView {
  Eigen::Matrix3d R_EC;                 ///< camera (x right, y down, z forward) to E
  Eigen::Matrix3d attitude_covariance;  ///< rad^2, rotation vector in E, left perturbation of R_EC
  Eigen::Vector2d position;             ///< m, of the camera
  Eigen::Matrix2d position_covariance;  ///< m^2
  double height_m = 0;                  ///< of the camera above the ground, along the vertical
  double height_sigma_m = 0;
};

}  // namespace redbee
