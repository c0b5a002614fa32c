// State of the inertial filter for a warm start after a clock jump, an IMU outage, or a restart of the
// process.
#pragma once

#include <Eigen/Core>

#include "redbee/geometry/time.hpp"

namespace redbee {

struct InertialParameters;

/// Sigmas: one standard deviation per component.
struct FilterSnapshot {
  CameraTime time{};    ///< of the frame that it is valid at
  double height_m = 0;  ///< of the camera above the ground plane
  double height_sigma_m = 0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();       ///< unit, in I
  Eigen::Vector3d up_sigma = Eigen::Vector3d::Zero();  ///< rad, of a rotation about each axis of I
  /// m/s, of the IMU, in the frame obtained from I by the smallest rotation that turns up into z: yaw is
  /// free, and a new filter starts with this yaw.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d gyro_bias_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d accel_bias_sigma = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_CI = Eigen::Matrix3d::Identity();    ///< the mounting, as estimated in flight
  Eigen::Vector3d R_CI_sigma = Eigen::Vector3d::Zero();  ///< rad, left perturbation
};

enum class SnapshotCheck {
  kAccepted,
  kNotWanted,    ///< the filter is past its first frame and has its own estimate
  kImplausible,  ///< not finite, or outside the range that a filter with these parameters can estimate
  kFuture,       ///< later than the filter's frame
  kStale,        ///< too old to constrain height, vertical and velocity
};
const char* toString(SnapshotCheck check);

/// True while height, vertical and velocity of the snapshot still constrain the frame at `time`.
bool isRecent(const FilterSnapshot& snapshot, CameraTime time);

/// Whether a filter with these parameters, at its first frame `time`, may be warm-started from it.
SnapshotCheck validate(const FilterSnapshot& snapshot, CameraTime time, const InertialParameters& parameters);

/// The snapshot propagated to the frame at `time`; precondition: isRecent(). The sigmas grow by the drone's
/// possible acceleration and rotation since, and are doubled, so that the filter is not overconfident after a
/// fault.
FilterSnapshot aged(FilterSnapshot snapshot, CameraTime time);

}  // namespace redbee
