// A simulated gimbal: how it turns the camera, exactly, and what it says of that.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/mount_track.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::simulation {

/// Of what the gimbal says; none by default.
struct GimbalErrors {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  ///< rad, rotation vector in M
  double noise_sigma = 0;                          ///< rad, white, about each axis of M
  double lag_s = 0;                                ///< s, it says where it was so long ago
  unsigned seed = 1;                               ///< of the noise
};

/// The camera's centre is where its axes meet.
struct Gimbal {
  std::array<Channel, 3> yaw_pitch_roll;  ///< rad; Rz(yaw) Ry(pitch) Rx(roll), mount: x forward, y left, z up
  bool is_stabilised = true;              ///< true: these turn M's coordinates into G's; false: into I's
  double rate_hz = 50;                    ///< Hz, of its messages
  GimbalErrors errors;

  /// Turns IMU coordinates into the mount's, exactly.
  Eigen::Matrix3d R_MI(const Trajectory& trajectory, double t_s) const;
};

/// What it says on [begin_s, end_s] of the trajectory's time. time = start + t.
std::vector<MountSample> simulateGimbal(const Gimbal& gimbal, const Trajectory& trajectory, double begin_s,
                                        double end_s, ImuTime start);

}  // namespace redbee::simulation
