// Gyro and accelerometer of a GoPro recording, from the packets of its GPMF track.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "redbee/importers/data_track.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct TimedVector {
  double t_s = 0;         ///< on the video's clock
  Eigen::Vector3d value;  ///< in the IMU frame I
};

struct GoproStreams {
  std::vector<TimedVector> gyro;   ///< rad/s
  std::vector<TimedVector> accel;  ///< m/s^2, specific force
  std::string damage;              ///< a line about values that are left out (impossible_values.hpp)
};

/// Frame I is x forward along the optical axis, y left, z up.
///
/// Axes: after ORIN/ORIO a GoPro lists (Z, X, Y) with Z up, X left and Y backward out of the lens' back. "Z
/// up" is confirmed by gravity (+9.7 in a HERO5's first channel), "Y backward" by the sample flight of
/// GoPro's own parser: a drone that accelerates forward at 3 m/s^2 (by its GPS velocities; correlation -0.98)
/// reads -3 in the third channel. In a right-handed frame X = Y x Z is then left, and the second channel's
/// sign agrees. So I = (-Y, X, Z), for both sensors: they are one chip.
///
/// Times: only the start of a payload, a batch of samples, has a time, but sampling is regular. A line fitted
/// to (samples before the payload, start of the payload) over the whole recording averages out the jitter of
/// the batches; STMP is used instead if the camera writes it. The samples of a single payload are spread
/// evenly over its duration.
///
/// Throws GpmfError if a payload is damaged, a unit is unknown, one of the sensors is missing, or more than a
/// tenth of its values cannot be any sensor's.
GoproStreams readGoproStreams(const std::vector<DataPacket>& packets);

/// Why the motion track says nothing about the images, in one line; std::nullopt if it does: the video's
/// clock is not the recorder's (by STMP, or by the sensors' rate), as in time lapse and slow motion. Throws
/// GpmfError like readGoproStreams().
std::optional<std::string> reasonToLeaveOut(const std::vector<DataPacket>& packets);

/// A sample at every gyro time, the accelerometer interpolated linearly and held constant beyond its ends.
std::vector<ImuSample> mergeAtGyroTimes(const GoproStreams& streams);

}  // namespace redbee
