// Between messages and the geolocation's types.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "processes/conversions.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geolocation/local_frame.hpp"
#include "redbee/geolocation/vehicle_pose.hpp"
#include "redbee/geolocation/view_estimator.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/pose_t.hpp"
#include "redbee/targets_t.hpp"

namespace redbee {

/// From w x y z.
inline Eigen::Quaterniond quaternionOf(const double (&q)[4]) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

inline VehiclePose vehiclePoseOf(const pose_t& m) {
  VehiclePose pose;
  pose.time = ImuTime(fromUtime(m.utime));
  pose.R_EB = quaternionOf(m.quat);
  pose.attitude_covariance = matrix3(m.attitude_covariance);
  if (m.has_velocity != 0) pose.velocity = vector3(m.velocity);
  if (m.has_global != 0) {
    pose.global = Geodetic{m.latitude, m.longitude};
    pose.position_covariance = matrix3(m.position_covariance).topLeftCorner<2, 2>();
    pose.altitude_m = m.altitude;
  }
  if (m.has_home_altitude != 0) pose.home_altitude_m = m.home_altitude;
  if (m.has_local != 0) pose.local = vector3(m.local);
  return pose;
}

inline MountAttitude mountAttitudeOf(const gimbal_t& m) {
  MountAttitude mount;
  mount.time = ImuTime(fromUtime(m.utime));
  if (m.has_body != 0) mount.R_BM = quaternionOf(m.quat_body);
  if (m.has_earth != 0) mount.R_EM = quaternionOf(m.quat_earth);
  return mount;
}

inline HeightAboveGround heightOf(const altimeter_t& m) {
  return {ImuTime(fromUtime(m.utime)), m.height, m.sigma};
}

inline std::vector<ObservedBox> boxesOf(const detections_t& m) {
  std::vector<ObservedBox> boxes;
  boxes.reserve(m.detections.size());
  for (const detection_t& d : m.detections) {
    boxes.push_back({d.id,
                     {static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.width),
                      static_cast<double>(d.height)},
                     d.seen != 0});
  }
  return boxes;
}

/// Of target_t::state.
inline const char* stateName(int8_t state) {
  return state == target_t::MOVING ? "moving" : state == target_t::STOPPED ? "stopped" : "coasting";
}

inline target_t messageOf(const Target& target, const LocalFrame& frame) {
  target_t message{};
  message.id = target.id;
  message.state = static_cast<int8_t>(target.state);
  if (frame.isGlobal()) {
    const Geodetic place = frame.geodeticOf(target.position);
    message.latitude = place.latitude_deg;
    message.longitude = place.longitude_deg;
  }
  fill(message.position, target.position);
  fill(message.position_covariance, target.position_covariance);
  fill(message.velocity, target.velocity);
  fill(message.velocity_covariance, target.velocity_covariance);
  fill(message.size, target.size);
  message.range = target.range_m;
  message.unseen = target.unseen_s;
  return message;
}

inline void fillView(targets_t& message, const ViewEstimate& estimate) {
  message.has_ground_altitude = estimate.has_ground_altitude ? 1 : 0;
  if (estimate.has_ground_altitude) message.ground_altitude = estimate.ground_altitude_m;
  message.has_view = estimate.view ? 1 : 0;
  if (!estimate.view) return;
  fill(message.camera_position, estimate.view->position);
  message.camera_height = estimate.view->height_m;
  fill(message.camera_axis, Eigen::Vector3d(estimate.view->R_EC.col(2)));
}

inline void fillFootprint(targets_t& message, const Eigen::Matrix<double, 2, 4>& footprint) {
  message.has_footprint = 1;
  std::copy_n(footprint.data(), 8, std::begin(message.footprint));
}

}  // namespace redbee
