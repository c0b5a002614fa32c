#include "redbee/simulation/flight_simulator.hpp"

#include <cmath>
#include <stdexcept>

#include "redbee/geometry/homography.hpp"

namespace redbee::simulation {
namespace {

constexpr double kRecordingMargin = 0.5;  // s of sensor data before the first and after the last exposure

const Scenario& checked(const Scenario& scenario) {
  if (scenario.frames <= 0 || !(scenario.fps > 0))
    throw std::invalid_argument("a flight needs frames and a frame rate");
  if (scenario.intrinsics.width <= 0 || scenario.intrinsics.height <= 0) {
    throw std::invalid_argument("a flight needs an image size");
  }
  return scenario;
}

/// Motion from camera a to camera b over the plane normal' X = normal' origin of G.
PlaneMotion motionOver(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal, const CameraPose& a,
                       const CameraPose& b) {
  const double distance = normal.dot(origin - a.p_GC);
  const Eigen::Vector3d towards = distance < 0 ? Eigen::Vector3d(-normal) : normal;
  return {b.R_CG * a.R_CG.transpose(), b.R_CG * (a.p_GC - b.p_GC), a.R_CG * towards, std::abs(distance)};
}

}  // namespace

FlightSimulator::FlightSimulator(const Scenario& scenario)
    : scenario_(checked(scenario)),
      camera_(scenario.intrinsics),
      renderer_(camera_, scenario.scene, scenario.sensor) {}

CameraTime FlightSimulator::frameTime(int k) const {
  return CameraTime(scenario_.start + fromSeconds(k / scenario_.fps));
}

double FlightSimulator::exposureTime(int k) const {
  return seconds(frameTime(k) - CameraTime(scenario_.start)) + scenario_.extrinsics.timeshift_s;
}

CameraPose FlightSimulator::pose(int k) const {
  return cameraPose(scenario_.trajectory.at(exposureTime(k)), scenario_.extrinsics);
}

SimulatedFrame FlightSimulator::frame(int k) const {
  return {frameTime(k), renderer_.render(pose(k), exposureTime(k), static_cast<unsigned>(k))};
}

Eigen::Matrix3d FlightSimulator::homography(int k) const {
  if (k == 0) return Eigen::Matrix3d::Identity();
  return planeHomography(camera_.K(), exactMotion(scenario_.trajectory, scenario_.extrinsics,
                                                  exposureTime(k - 1), exposureTime(k)));
}

Eigen::Matrix3d FlightSimulator::frontHomography(int k, size_t patch) const {
  const Patch& plane = scenario_.scene.patches.at(patch);
  if (plane.kind == PatchKind::kMover) throw std::invalid_argument("a moving patch has no homography here");
  if (k == 0) return Eigen::Matrix3d::Identity();
  return planeHomography(camera_.K(), motionOver(plane.centre, plane.normal(), pose(k - 1), pose(k)));
}

double FlightSimulator::recordingEnd() const { return exposureTime(scenario_.frames - 1) + kRecordingMargin; }

std::vector<ImuSample> FlightSimulator::imu() const {
  return simulateImu(scenario_.trajectory, exposureTime(0) - kRecordingMargin, recordingEnd(),
                     ImuTime(scenario_.start), scenario_.imu);
}

std::vector<AltitudeSample> FlightSimulator::altimeter() const {
  return simulateAltimeter(scenario_.trajectory, scenario_.extrinsics, exposureTime(0) - kRecordingMargin,
                           recordingEnd(), ImuTime(scenario_.start), scenario_.altimeter.rate_hz,
                           scenario_.altimeter.sigma_m, scenario_.altimeter.seed);
}

}  // namespace redbee::simulation
