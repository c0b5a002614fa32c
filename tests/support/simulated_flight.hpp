// A simulated flight over flat ground without images: exact motions and homographies between any two times,
// and measurements of IMU and altimeter. The trajectory runs on the IMU's clock, frames are on the camera's.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/trajectory.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

inline constexpr double kFrameRate = 24;                         ///< Hz
inline constexpr CameraTime kStart{std::chrono::seconds(1000)};  ///< of frame 0

inline CameraTime frameTime(int k, CameraTime start = kStart, double frame_rate = kFrameRate) {
  return start + Duration(std::llround(k * 1e6 / frame_rate));
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
  SimulatedFlight(simulation::Trajectory trajectory, const InertialExtrinsics& mounting, CameraTime start)
      : extrinsics(mounting), trajectory_(std::move(trajectory)), start_(start) {}

  /// Between two frames.
  PlaneMotion motion(CameraTime a, CameraTime b) const {
    return simulation::exactMotion(trajectory_, extrinsics, trajectoryTime(a), trajectoryTime(b));
  }
  Eigen::Matrix3d homography(CameraTime a, CameraTime b) const {
    return planeHomography(camera().K(), motion(a, b));
  }
  /// Of the camera above the ground [m].
  double heightAt(CameraTime frame) const { return motion(frame, frame + std::chrono::milliseconds(10)).h_a; }

  /// From half a second before the first frame to `end_s` after it.
  std::vector<ImuSample> imu(const simulation::ImuSimulatorParameters& parameters, double end_s) const {
    return simulation::simulateImu(trajectory_, -0.5, end_s, imuStart(), parameters);
  }
  /// 50 Hz, sigma 5 cm.
  std::vector<AltitudeSample> altimeter(double begin_s, double end_s, unsigned seed) const {
    return simulation::simulateAltimeter(trajectory_, extrinsics, begin_s, end_s, imuStart(), 50, 0.05, seed);
  }

  InertialExtrinsics extrinsics;  ///< true ones

 private:
  ImuTime imuStart() const { return toImu(start_, Duration(0)); }
  double trajectoryTime(CameraTime frame) const { return seconds(frame - start_) + extrinsics.timeshift_s; }

  simulation::Trajectory trajectory_;
  CameraTime start_;
};

}  // namespace redbee::test
