// The rotation of the camera's mount against the IMU over time, as a gimbal says it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <deque>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/gimbal_parameters.hpp"

namespace redbee {

/// On the IMU's clock.
struct MountSample {
  ImuTime time{};
  Eigen::Quaterniond q_IM;  ///< turns the mount's coordinates into the IMU's; identity at rest
};

/// Of the mount at one time. A camera that is fixed to the IMU has the default: known, without an error.
struct MountRotation {
  Eigen::Matrix3d R_MI = Eigen::Matrix3d::Identity();  ///< turns IMU coordinates into the mount's
  Eigen::Vector3d rate_M = Eigen::Vector3d::Zero();    ///< rad/s, of M relative to I, in M
  double variance = 0;                                 ///< rad^2, of R_MI about each axis, anew in each frame
  bool is_known = true;                                ///< false: R_MI is a guess
};

class MountTrack {
 public:
  explicit MountTrack(const GimbalParameters& parameters) : parameters_(parameters) {}

  /// In any order; of two with the same time the later one counts. A clock that was set back forgets what
  /// came before. Refuses a sample that is not a rotation or has an implausible time, and then returns false.
  bool add(const MountSample& sample);
  /// Whether a sample as late as `time` has come.
  bool reaches(ImuTime time) const;
  /// Interpolated (slerp) between the two samples that `time` lies between; not known where these are further
  /// apart than `max_gap_s`, or where there is none on one side: nothing is extrapolated.
  MountRotation at(ImuTime time) const;
  /// What lies further back than this is not asked for any more.
  void eraseBefore(ImuTime time);

 private:
  GimbalParameters parameters_;
  std::deque<MountSample> samples_;  ///< in order of time
};

}  // namespace redbee
