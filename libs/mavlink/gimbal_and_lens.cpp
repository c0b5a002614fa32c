// The members of VehicleState that are about the camera's mount.
#include <algorithm>
#include <cmath>

#include "redbee/mavlink/axes.hpp"
#include "redbee/mavlink/vehicle_state.hpp"

namespace redbee::mavlink {
namespace {

constexpr double kPerDegree = M_PI / 180;
constexpr Duration kAttitudeFor = std::chrono::milliseconds(500);

Eigen::Quaterniond aboutDown(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

bool isAgainstNorth(uint16_t flags) {
  using Status = GimbalDeviceAttitudeStatus;
  if ((flags & Status::kYawInEarthFrame) != 0) return true;
  return (flags & Status::kYawInVehicleFrame) == 0 && (flags & Status::kYawLock) != 0;
}

}  // namespace

GimbalAttitude VehicleState::gimbalFrom(const Eigen::Quaterniond& ned_from_gimbal, ImuTime time) const {
  GimbalAttitude gimbal;
  gimbal.time = time;
  gimbal.enu_from_gimbal = enuRotation(ned_from_gimbal);
  const bool is_fresh = attitude_ && std::abs((time - attitude_->time).count()) <= kAttitudeFor.count();
  if (is_fresh) gimbal.body_from_gimbal = fluRotation(attitudeAt(time).conjugate() * ned_from_gimbal);
  return gimbal;
}

/// A brisk body turns by a degree until the next message.
Eigen::Quaterniond VehicleState::attitudeAt(ImuTime time) const {
  constexpr double kCarried_s = 0.1;  // then it may turn the other way
  const double since_s = std::clamp(seconds(time - attitude_->time), -kCarried_s, kCarried_s);
  const double angle = body_rate_.norm() * since_s;
  if (angle == 0) return attitude_->value;
  return (attitude_->value * Eigen::Quaterniond(Eigen::AngleAxisd(angle, body_rate_.normalized())))
      .normalized();
}

std::optional<GimbalAttitude> VehicleState::gimbalOf(const GimbalDeviceAttitudeStatus& m,
                                                     ImuTime time) const {
  const auto q = rotationOf(m.q[0], m.q[1], m.q[2], m.q[3]);
  if (!q) return std::nullopt;
  if (isAgainstNorth(m.flags)) return gimbalFrom(*q, time);
  // Level, with the vehicle's heading: which heading that is, the gimbal may say itself.
  const bool says_heading = (m.flags & GimbalDeviceAttitudeStatus::kYawInVehicleFrame) != 0 &&
                            std::isfinite(m.delta_yaw) && m.delta_yaw != 0;
  if (says_heading) return gimbalFrom(aboutDown(m.delta_yaw) * *q, time);
  if (!isFresh(attitude_, time)) return std::nullopt;
  return gimbalFrom(aboutDown(headingOf(attitudeAt(time))) * *q, time);
}

std::optional<GimbalAttitude> VehicleState::gimbalOf(const MountOrientation& m, ImuTime time) const {
  if (!std::isfinite(m.roll) || !std::isfinite(m.pitch) || !std::isfinite(m.yaw)) return std::nullopt;
  if (!isFresh(attitude_, time)) return std::nullopt;
  const Eigen::Quaterniond level_from_gimbal =
      aboutDown(m.yaw * kPerDegree) *
      Eigen::Quaterniond(Eigen::AngleAxisd(m.pitch * kPerDegree, Eigen::Vector3d::UnitY())) *
      Eigen::Quaterniond(Eigen::AngleAxisd(m.roll * kPerDegree, Eigen::Vector3d::UnitX()));
  return gimbalFrom(aboutDown(headingOf(attitudeAt(time))) * level_from_gimbal, time);
}

Lens VehicleState::lensOf(const CameraSettings& m, ImuTime time) const {
  Lens lens;
  lens.time = time;
  if (std::isfinite(m.zoom_level) && m.zoom_level >= 0 && m.zoom_level <= 100)
    lens.zoom = m.zoom_level * 0.01;
  const bool has_focal_length = camera_ && std::isfinite(camera_->focal_length) &&
                                camera_->focal_length > 0 && std::isfinite(camera_->sensor_size_h) &&
                                camera_->sensor_size_h > 0 && camera_->resolution_h > 0;
  if (has_focal_length && lens.zoom.value_or(0) == 0) {
    lens.focal_px = camera_->focal_length / camera_->sensor_size_h * camera_->resolution_h;
    lens.width_px = camera_->resolution_h;
  }
  return lens;
}

std::optional<Lens> VehicleState::lensOf(const CameraFovStatus& m, ImuTime time) {
  constexpr float kWidest_deg = 170;  // a wider one is that of a lens to which no pinhole is near
  constexpr int kWidth_px = 10000;    // any will do
  if (!std::isfinite(m.hfov) || m.hfov <= 0 || m.hfov > kWidest_deg) return std::nullopt;
  Lens lens;
  lens.time = time;
  lens.focal_px = 0.5 * kWidth_px / std::tan(m.hfov * kPerDegree / 2);
  lens.width_px = kWidth_px;
  return lens;
}

}  // namespace redbee::mavlink
