// True messages of every type that is sent, from a simulated flight.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

#include "processes/autopilot/measurement_messages.hpp"
#include "processes/geolocation/target_messages.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/node/message_check.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {

/// One true message of each type that is sent, with as many members valid as possible.
struct TrueMessages {
  StackOutput output;
  std::optional<filter_snapshot_t> snapshot;

  template <typename Message>
  Message get() const;
};

inline const TrueMessages& trueMessages() {
  static const TrueMessages* const messages = [] {
    auto* made = new TrueMessages;
    const auto bus = makeLcmBus("memq://");
    const Subscription subscription = bus->subscribe<filter_snapshot_t>(
        "FILTER_SNAPSHOT", 64, [&](const filter_snapshot_t& m) { made->snapshot = m; });
    made->output = StackRun(undisturbedFlight(), *bus).run();
    return made;
  }();
  return *messages;
}

template <typename Message>
Message firstOn(const std::string& channel) {
  for (const SensorMessage& sent : undisturbedFlight().messages) {
    Message message;
    if (sent.channel == channel && decodePlausible(sent.data, message)) return message;
  }
  throw std::logic_error("the simulated flight has no message on " + channel);
}
template <typename Messages>
auto lastOf(const Messages& messages) {
  return messages.rbegin()->second;
}

template <>
inline image_t TrueMessages::get() const {
  return firstOn<image_t>("CAMERA");
}
template <>
inline ins_t TrueMessages::get() const {
  return firstOn<ins_t>("IMU");
}
template <>
inline altimeter_t TrueMessages::get() const {
  return firstOn<altimeter_t>("ALTIMETER");
}
template <>
inline filter_snapshot_t TrueMessages::get() const {
  return snapshot.value();
}
/// That of a rolling shutter.
inline row_motion_t trueRowMotion() {
  row_motion_t motion{};
  motion.valid = 1;
  motion.rate[0] = 0.5;
  motion.normal[2] = 1;
  return motion;
}
template <>
inline inertial_homography_t TrueMessages::get() const {
  inertial_homography_t message = lastOf(output.inertial);
  message.row_motion = trueRowMotion();
  return message;
}
template <>
inline visual_homography_t TrueMessages::get() const {
  return lastOf(output.visual);
}
template <>
inline fused_homography_t TrueMessages::get() const {
  fused_homography_t message = lastOf(output.fused);
  message.has_front = 1;
  message.row_motion = trueRowMotion();
  std::copy(std::begin(message.step.H), std::end(message.step.H), std::begin(message.H_front));
  return message;
}
template <>
inline foreground_t TrueMessages::get() const {
  return lastOf(output.foreground);
}
template <>
inline detections_t TrueMessages::get() const {
  for (const auto& [utime, message] : output.detections) {
    if (message.n > 0) return message;
  }
  throw std::logic_error("nothing was detected");
}
template <>
inline process_health_t TrueMessages::get() const {
  return output.health.at("redbee-homography-fusion");
}

/// Of an autopilot with a fix, its gimbal and its camera.
template <>
inline pose_t TrueMessages::get() const {
  mavlink::Pose pose;
  pose.time = ImuTime(fromSeconds(100));
  pose.enu_from_flu = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  pose.attitude_covariance = pose.velocity_covariance = 0.01 * Eigen::Matrix3d::Identity();
  pose.velocity = Eigen::Vector3d(1, 2, 3);
  pose.local = Eigen::Vector3d(4, 5, 6);
  pose.global = mavlink::GlobalPosition{47.3, 8.5, 500, 547, 10, Eigen::Matrix3d::Identity()};
  return messageOf(pose);
}
template <>
inline gimbal_t TrueMessages::get() const {
  const Eigen::Quaterniond mount(0.5, 0.5, -0.5, 0.5);
  return messageOf(mavlink::GimbalAttitude{ImuTime(fromSeconds(100)), mount, mount});
}
template <>
inline lens_t TrueMessages::get() const {
  return messageOf(mavlink::Lens{ImuTime(fromSeconds(100)), 0.5, 1000, 1920});
}
template <>
inline clock_offset_t TrueMessages::get() const {
  return messageOf(mavlink::ClockState{100'000'000'000, -5'000'000, 1e-5, 1e-3, 2e-3});
}

/// Of a flight with a fix, its one target in view.
template <>
inline targets_t TrueMessages::get() const {
  LocalFrame frame;
  VehiclePose pose;
  pose.global = Geodetic{47.3, 8.5};
  frame.placeOf(pose);
  Target target;
  target.id = 3;
  target.position = {10, 20};
  target.velocity = {1, -2};
  target.position_covariance = target.velocity_covariance = Eigen::Matrix2d::Identity();
  target.size = {1, 2};
  target.range_m = 50;
  target.unseen_s = 0.5;
  targets_t message{};
  message.utime = 100'000'000;
  message.has_global = message.has_view = message.has_ground_altitude = 1;
  message.camera_height = 40;
  message.camera_axis[2] = -1;
  message.ground_altitude = 500;
  fillFootprint(message, Eigen::Matrix<double, 2, 4>::Ones());
  message.n = 1;
  message.targets.push_back(messageOf(target, frame));
  return message;
}

}  // namespace redbee::test
