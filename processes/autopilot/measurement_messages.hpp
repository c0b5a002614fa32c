// Messages from what the autopilot measures and estimates.
#pragma once

#include <algorithm>
#include <iterator>

#include "processes/conversions.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/clock_offset_t.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/mavlink/measurements.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {

/// w x y z.
inline void fill(double (&entries)[4], const Eigen::Quaterniond& q) {
  const double ordered[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(std::begin(ordered), std::end(ordered), std::begin(entries));
}

inline ins_t messageOf(const mavlink::ImuReading& reading) {
  ins_t message{};
  message.utime = toUtime(reading.time);
  message.device_time = reading.device_us;
  fill(message.gyro, reading.gyro);
  fill(message.accel, reading.accel);
  fill(message.mag, reading.mag);
  message.pressure = reading.pressure_hpa;
  message.rel_alt = reading.pressure_altitude_m;
  return message;
}

inline altimeter_t messageOf(const mavlink::HeightReading& reading) {
  altimeter_t message{};
  message.utime = toUtime(reading.time);
  message.height = reading.height_m;
  message.sigma = reading.sigma_m;
  return message;
}

inline void fillGlobal(pose_t& message, const mavlink::GlobalPosition& global) {
  message.has_global = message.has_home_altitude = 1;
  message.latitude = global.latitude_deg;
  message.longitude = global.longitude_deg;
  message.altitude = global.altitude_m;
  message.home_altitude = global.home_altitude_m;
  fill(message.position_covariance, global.covariance);
  if (!global.ellipsoid_altitude_m) return;
  message.has_ellipsoid_altitude = 1;
  message.ellipsoid_altitude = *global.ellipsoid_altitude_m;
}

inline pose_t messageOf(const mavlink::Pose& pose) {
  pose_t message{};
  message.utime = toUtime(pose.time);
  fill(message.quat, pose.enu_from_flu);
  fill(message.attitude_covariance, pose.attitude_covariance);
  if (pose.velocity) {
    message.has_velocity = 1;
    fill(message.velocity, *pose.velocity);
    fill(message.velocity_covariance, pose.velocity_covariance);
  }
  if (pose.global) fillGlobal(message, *pose.global);
  if (pose.local) {
    message.has_local = 1;
    fill(message.local, *pose.local);
  }
  return message;
}

inline gimbal_t messageOf(const mavlink::GimbalAttitude& gimbal) {
  gimbal_t message{};
  message.utime = toUtime(gimbal.time);
  message.has_body = gimbal.body_from_gimbal ? 1 : 0;
  message.has_earth = gimbal.enu_from_gimbal ? 1 : 0;
  if (gimbal.body_from_gimbal) fill(message.quat_body, *gimbal.body_from_gimbal);
  if (gimbal.enu_from_gimbal) fill(message.quat_earth, *gimbal.enu_from_gimbal);
  return message;
}

inline lens_t messageOf(const mavlink::Lens& lens) {
  lens_t message{};
  message.utime = toUtime(lens.time);
  message.has_zoom = lens.zoom ? 1 : 0;
  message.zoom = lens.zoom.value_or(0);
  message.has_focal_length = lens.focal_px ? 1 : 0;
  message.focal_length = lens.focal_px.value_or(0);
  message.width = lens.width_px;
  return message;
}

inline clock_offset_t messageOf(const mavlink::ClockState& clock) {
  clock_offset_t message{};
  message.utime = fromNanoseconds(clock.host_ns).count();
  message.offset = clock.offset_ns;
  message.drift = clock.drift;
  message.sigma = clock.sigma_s;
  message.round_trip = clock.round_trip_s;
  return message;
}

}  // namespace redbee
