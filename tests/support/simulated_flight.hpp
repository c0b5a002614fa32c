// A flight of the camera over flat ground without images: exact motions and homographies between any two
// times, and what IMU and altimeter measure meanwhile. The trajectory runs on the IMU's clock, frames are on
// the camera's.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/trajectory.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

inline constexpr double kFrameRate = 24;          ///< Hz
inline constexpr int64_t kStart = 1'000'000'000;  ///< us, of frame 0

inline int64_t frameTime(int k, int64_t start = kStart, double frame_rate = kFrameRate) {
  return start + static_cast<int64_t>(std::llround(k * 1e6 / frame_rate));
}

/// Optical axis along IMU x, `pitch_deg` below the horizon; 5 cm from the IMU.
inline InertialExtrinsics mountedCamera(double start_height_m, double pitch_deg = 40) {
  Eigen::Matrix3d level;
  level << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  InertialExtrinsics extrinsics;
  extrinsics.R_CI = expSO3({pitch_deg * M_PI / 180, 0, 0}) * level;
  extrinsics.p_IC = {0.04, -0.02, 0.02};
  extrinsics.timeshift_s = 0.006;
  extrinsics.start_height_m = start_height_m;
  return extrinsics;
}

class SimulatedFlight {
 public:
  /// Ordinary flight of the mounted camera, 24 frames a second.
  SimulatedFlight(unsigned seed, double height_m)
      : SimulatedFlight(simulation::Trajectory::ordinary(seed, height_m), mountedCamera(height_m), kStart) {
    extrinsics.start_height_m = heightAt(kStart);
  }
  SimulatedFlight(simulation::Trajectory trajectory, const InertialExtrinsics& mounting, int64_t start)
      : extrinsics(mounting), trajectory_(std::move(trajectory)), start_(start) {}

  /// Between two times of the camera's clock.
  PlaneMotion motion(int64_t utime_a, int64_t utime_b) const {
    return simulation::exactMotion(trajectory_, extrinsics, trajectoryTime(utime_a), trajectoryTime(utime_b));
  }
  Eigen::Matrix3d homography(int64_t utime_a, int64_t utime_b) const {
    return planeHomography(camera().K(), motion(utime_a, utime_b));
  }
  /// Of the camera above the ground [m].
  double heightAt(int64_t utime) const { return motion(utime, utime + 10'000).h_a; }

  /// From half a second before the first frame to `end_s` after it.
  std::vector<ImuSample> imu(const simulation::ImuSimulatorParameters& parameters, double end_s) const {
    return simulation::simulateImu(trajectory_, -0.5, end_s, start_, parameters);
  }
  /// 50 Hz, sigma 5 cm.
  std::vector<AltitudeSample> altimeter(double begin_s, double end_s, unsigned seed) const {
    return simulation::simulateAltimeter(trajectory_, extrinsics, begin_s, end_s, start_, 50, 0.05, seed);
  }

  InertialExtrinsics extrinsics;  ///< true ones

 private:
  double trajectoryTime(int64_t utime) const {
    return static_cast<double>(utime - start_) * 1e-6 + extrinsics.timeshift_s;
  }

  simulation::Trajectory trajectory_;
  int64_t start_;
};

}  // namespace redbee::test
