// What a filter has learned in flight, for the filter that takes its place: after a jump of the clock, an
// outage of the IMU, the death of a process.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace redbee {

struct InertialParameters;

/// Sigmas are one standard deviation each, by component.
struct FilterSnapshot {
  int64_t utime = 0;    ///< us, camera clock: the frame that it holds for
  double height_m = 0;  ///< of the camera above the ground plane
  double height_sigma_m = 0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();       ///< unit, in I
  Eigen::Vector3d up_sigma = Eigen::Vector3d::Zero();  ///< rad, of a rotation about each axis of I
  /// m/s, of the IMU, in the frame that the least rotation makes of I when it turns up into z: yaw is free,
  /// and this is the one that a new filter begins with.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d gyro_bias_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d accel_bias_sigma = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_CI = Eigen::Matrix3d::Identity();    ///< the mounting, as corrected in flight
  Eigen::Vector3d R_CI_sigma = Eigen::Vector3d::Zero();  ///< rad, left perturbation
};

enum class SnapshotCheck {
  kBelieved,
  kNotWanted,    ///< the filter has moved, and flies by what it has learned itself
  kImplausible,  ///< not finite, or nothing that a filter with these parameters could have learned
  kFuture,       ///< of a frame later than the filter's
  kStale,        ///< too old to say where the drone is
};
const char* toString(SnapshotCheck verdict);

/// True while height, vertical and velocity of then say something about the frame at `utime`.
bool isRecent(const FilterSnapshot& known, int64_t utime);

/// May a filter with these parameters, at its first frame `utime`, go on from it?
SnapshotCheck judge(const FilterSnapshot& known, int64_t utime, const InertialParameters& parameters);

/// What is left of it at the frame at `utime`; precondition: isRecent(). Nobody has measured since: the drone
/// may have accelerated and turned, and the sigmas grow by that. They are doubled besides: what follows a
/// fault is not to be surer than it can show.
FilterSnapshot aged(FilterSnapshot known, int64_t utime);

}  // namespace redbee
