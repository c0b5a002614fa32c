// A simulated flight: images, IMU and altimeter of one trajectory over one scene, with ground truth.
//
// Clocks: the trajectory runs on the IMU's clock, time = start + t. Frame k carries the camera's
// clock, start + k / fps, and was exposed at t_imu = t_cam + timeshift (Kalibr's sign).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/simulation/gimbal.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/renderer.hpp"
#include "redbee/simulation/scene.hpp"
#include "redbee/simulation/trajectory.hpp"
#include "redbee/simulation/zoom_lens.hpp"

namespace redbee::simulation {

struct AltimeterParameters {
  double rate_hz = 50;
  double sigma_m = 0.05;  ///< m
  unsigned seed = 1;
};

struct Scenario {
  Trajectory trajectory;
  CameraIntrinsics intrinsics;
  InertialExtrinsics extrinsics;  ///< true ones, the time shift included
  ImuSimulatorParameters imu;
  AltimeterParameters altimeter;
  Scene scene;
  SensorParameters sensor;
  double fps = 24;
  int frames = 240;
  Duration start{
      1700000000000000};  ///< time of both clocks at the start of the trajectory, except for the time shift
  std::optional<Gimbal> gimbal{};  ///< turns the camera from the mounting of `extrinsics`
  std::optional<ZoomLens> lens{};  ///< of the focal length of `intrinsics` times its zoom
};

struct SimulatedFrame {
  CameraTime time{};
  RenderedImage image;
};

class FlightSimulator {
 public:
  /// Throws std::invalid_argument for an invalid scenario (no frames, no image size, fps <= 0).
  explicit FlightSimulator(const Scenario& scenario);

  const Scenario& scenario() const { return scenario_; }
  const Camera& camera() const { return camera_; }

  /// Any k >= 0, in any order; frame k is always the same.
  SimulatedFrame frame(int k) const;
  CameraTime frameTime(int k) const;
  double exposureTime(int k) const;  ///< trajectory time [s]; with a rolling shutter of the middle row
  CameraPose pose(int k) const;      ///< at that time
  CameraPose poseAt(double t_s) const;
  /// Focal length of frame k over the configured one.
  double zoom(int k) const { return scenario_.lens ? scenario_.lens->zoom(exposureTime(k)) : 1; }
  /// True motion during the read-out of frame k.
  RowMotion rowMotion(int k) const;

  /// Exact motion over the ground between exposureTime(k - 1) and exposureTime(k).
  PlaneMotion motion(int k) const;
  /// Exact homography of the ground between exposureTime(k - 1) and exposureTime(k), ideal pixels. Identity
  /// for k = 0.
  Eigen::Matrix3d homography(int k) const;
  /// The same for the plane of a static patch (index in scene.patches). Throws std::invalid_argument for a
  /// patch that moves, sways, or turns towards the camera.
  Eigen::Matrix3d frontHomography(int k, size_t patch) const;

  /// From half a second before the first exposure to half a second after the last one.
  std::vector<ImuSample> imu() const;
  std::vector<AltitudeSample> altimeter() const;
  /// Empty without a gimbal.
  std::vector<MountSample> gimbal() const;
  /// Empty without a lens that zooms.
  std::vector<LensSample> lens() const;

 private:
  double recordingEnd() const;
  /// Of the frames k - 1 and k.
  CameraPair cameras(int k) const;

  Scenario scenario_;
  Camera camera_;
  Renderer renderer_;
};

}  // namespace redbee::simulation
