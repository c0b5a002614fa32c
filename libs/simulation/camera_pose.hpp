// Pose of the camera from the pose of the IMU.
#pragma once

#include <Eigen/Core>

#include "redbee/inertial/imu.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::simulation {

struct CameraPose {
  Eigen::Matrix3d R_CG;  ///< turns ground coordinates into camera coordinates
  Eigen::Vector3d p_GC;  ///< camera centre in G [m]
};

inline CameraPose cameraPose(const TrajectoryState& state, const InertialExtrinsics& extrinsics) {
  return {extrinsics.R_CI * state.R_GI.transpose(), state.p_GI + state.R_GI * extrinsics.p_IC};
}

}  // namespace redbee::simulation
