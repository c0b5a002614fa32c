#include "redbee/simulation/flight_simulator.hpp"

#include <cmath>
#include <stdexcept>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"

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

CameraPose FlightSimulator::poseAt(double t_s) const {
  InertialExtrinsics extrinsics = scenario_.extrinsics;
  if (scenario_.gimbal) extrinsics.R_CI *= scenario_.gimbal->R_MI(scenario_.trajectory, t_s);
  return cameraPose(scenario_.trajectory.at(t_s), extrinsics);
}

CameraPose FlightSimulator::pose(int k) const { return poseAt(exposureTime(k)); }

RowMotion FlightSimulator::rowMotion(int k) const {
  constexpr double kStep_s = 1e-4;
  const double t_s = exposureTime(k);
  const CameraPose at = pose(k);
  const auto rateAt = [&](double when_s) -> Eigen::Vector3d {
    if (!scenario_.gimbal) return scenario_.extrinsics.R_CI * scenario_.trajectory.at(when_s).omega_I;
    const Eigen::Matrix3d before = poseAt(when_s - kStep_s).R_CG, after = poseAt(when_s + kStep_s).R_CG;
    return logSO3(before * after.transpose()) / (2 * kStep_s);
  };
  RowMotion motion;
  motion.rate = rateAt(t_s);
  motion.acceleration = (rateAt(t_s + kStep_s) - rateAt(t_s - kStep_s)) / (2 * kStep_s);
  const Eigen::Vector3d velocity = (poseAt(t_s + kStep_s).p_GC - poseAt(t_s - kStep_s).p_GC) / (2 * kStep_s);
  motion.velocity = at.R_CG * velocity / at.p_GC.z();
  motion.normal = -at.R_CG.col(2);
  return motion;
}

SimulatedFrame FlightSimulator::frame(int k) const {
  return {frameTime(k), renderer_.render([this](double t_s) { return poseAt(t_s); }, exposureTime(k),
                                         static_cast<unsigned>(k), zoom(k))};
}

CameraPair FlightSimulator::cameras(int k) const {
  return {zoomed(camera_.K(), zoom(k - 1)), zoomed(camera_.K(), zoom(k))};
}

PlaneMotion FlightSimulator::motion(int k) const {
  return motionOver(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), pose(k - 1), pose(k));
}

Eigen::Matrix3d FlightSimulator::homography(int k) const {
  if (k == 0) return Eigen::Matrix3d::Identity();
  return planeHomography(cameras(k), motion(k));
}

Eigen::Matrix3d FlightSimulator::frontHomography(int k, size_t patch) const {
  const Patch& plane = scenario_.scene.patches.at(patch);
  if (plane.kind == PatchKind::kMover || plane.is_round || plane.sway)
    throw std::invalid_argument("a patch that moves or turns has no homography here");
  if (k == 0) return Eigen::Matrix3d::Identity();
  return planeHomography(cameras(k), motionOver(plane.centre, plane.normal(), pose(k - 1), pose(k)));
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

std::vector<MountSample> FlightSimulator::gimbal() const {
  if (!scenario_.gimbal) return {};
  return simulateGimbal(*scenario_.gimbal, scenario_.trajectory, exposureTime(0) - kRecordingMargin,
                        recordingEnd(), ImuTime(scenario_.start));
}

std::vector<LensSample> FlightSimulator::lens() const {
  if (!scenario_.lens) return {};
  return simulateLens(*scenario_.lens, exposureTime(0) - kRecordingMargin, recordingEnd(),
                      ImuTime(scenario_.start));
}

}  // namespace redbee::simulation
