// Initial values of the joint problem, from rotations, gravity and homographies; no prior on the motion is
// needed.
#pragma once

#include <vector>

#include "redbee/calibration/joint_problem.hpp"
#include "redbee/calibration/joint_state.hpp"

namespace redbee::calibration {

/// Result of the rotation alignment (rotation_alignment.hpp), or the nominal values.
struct Mounting {
  Eigen::Matrix3d R_CI = Eigen::Matrix3d::Identity();
  double rotation_sigma_rad = 0.09;  ///< uncertainty of R_CI so far
  Eigen::Vector3d p_IC = Eigen::Vector3d::Zero();
  double timeshift_s = 0;
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
};

/// Frame times (camera clock, increasing) become a state with biases in stretches of `kBiasStretch_s`.
JointState emptyState(const std::vector<double>& t_cam_s, const Mounting& mounting);
inline constexpr double kBiasStretch_s = 1.0;

/// Flight over ground: attitudes from the gyro and the mean direction of specific force; path in units of the
/// first height from the homographies' t / h; the height itself from the altimeter, else from comparing the
/// path's curvature with the accelerometer, else `priors.height_m`.
void initialiseOverGround(JointState& state, const JointInput& input);

/// Before a target: poses from the target, upright by the mean direction of specific force.
void initialiseBeforeTarget(JointState& state, const JointInput& input);

/// First height [m] for which a path in units of it fits the accelerometer; 0 where the flight has too little
/// acceleration. `path`: one point per frame, in G.
double heightFromAcceleration(const JointState& state, const JointInput& input,
                              const std::vector<Eigen::Vector3d>& path);

}  // namespace redbee::calibration
