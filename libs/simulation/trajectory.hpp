// An analytic trajectory: position and attitude as sums of sinusoids, with exact velocity, acceleration and
// angular rate.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace redbee::simulation {

struct Sinusoid {
  double amplitude = 0;     ///< m or rad
  double frequency_hz = 0;  ///< Hz
  double phase = 0;         ///< rad
};

/// offset + rate * t + sum of sinusoids.
struct Channel {
  double offset = 0;
  double rate = 0;
  std::vector<Sinusoid> sinusoids;

  double at(double t_s) const;
};

struct TrajectoryParameters {
  std::array<Channel, 3> position;  ///< of the IMU in G [m]: x, y, z (up)
  std::array<Channel, 3>
      yaw_pitch_roll;  ///< rad; R_GI = Rz(yaw) Ry(pitch) Rx(roll), IMU: x forward, y left, z up
};

struct TrajectoryState {
  Eigen::Vector3d p_GI;  ///< m
  Eigen::Vector3d v_GI;  ///< m/s
  Eigen::Vector3d a_GI;  ///< m/s^2
  Eigen::Matrix3d R_GI;
  Eigen::Vector3d omega_I;  ///< rad/s, of I relative to G, in I
};

class Trajectory {
 public:
  explicit Trajectory(TrajectoryParameters parameters) : parameters_(std::move(parameters)) {}
  /// State at this time [s]; any time, also negative.
  TrajectoryState at(double t_s) const;

  /// Ordinary flight along +x of G: one to three metres a second, turns within 10 degrees about all axes. The
  /// mean tilt of the camera is in its mounting (R_CI). The same seed gives the same flight.
  static Trajectory ordinary(unsigned seed, double height_m);
  /// The same path with brisk turns, up to some 70 degrees a second.
  static Trajectory brisk(unsigned seed, double height_m);
  /// Any way over a landscape: forwards, sideways, climbing, turning, faster the higher it is.
  static Trajectory varied(unsigned seed, double height_m);
  /// Strong rotation about all axes (25 degrees, 0.3 to 1 Hz) over flat ground, for calibration.
  static Trajectory calibration(unsigned seed, double height_m);

 private:
  TrajectoryParameters parameters_;
};

}  // namespace redbee::simulation
