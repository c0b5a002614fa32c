// Gyro and accelerometer of a GoPro recording, from the packets of its GPMF track.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "redbee/importers/video_reader.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct TimedVector {
  double t_s = 0;         ///< on the video's clock
  Eigen::Vector3d value;  ///< in the IMU frame I
};

struct GoproStreams {
  std::vector<TimedVector> gyro;   ///< rad/s
  std::vector<TimedVector> accel;  ///< m/s^2, specific force
};

/// Frame I is x forward along the optical axis, y left, z up.
///
/// Axes: after ORIN/ORIO a GoPro lists (Z, X, Y) with Z up, X left and Y backward out of the lens' back. "Z
/// up" shows in gravity (+9.7 in a HERO5's first channel). "Y backward" shows in the sample flight of GoPro's
/// own parser: a drone that accelerates forward by 3 m/s^2 (by its GPS velocities; correlation -0.98) reads
/// -3 in the third channel. Two axes and a right-handed frame leave X = Y x Z = left, and the second
/// channel's sign agrees. So I = (-Y, X, Z), for both sensors: they are one chip.
///
/// Times: a payload's start is known to a whole batch of samples only, but the sampling is regular. A
/// straight line through (samples before the payload, start of the payload) over the whole recording averages
/// the batches out; STMP, where the camera writes it, replaces the counting. One payload alone is spread
/// evenly over its duration.
///
/// Throws GpmfError if a payload is damaged, a unit is not known, or one of the sensors is missing.
GoproStreams readGoproStreams(const std::vector<DataPacket>& packets);

/// A sample at every gyro time, the accelerometer interpolated linearly; held at the ends.
std::vector<ImuSample> mergeAtGyroTimes(const GoproStreams& streams);

}  // namespace redbee
