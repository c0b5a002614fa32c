// The attitude in angles, which many links carry where nobody has asked for the quaternion.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>

#include "redbee/mavlink/sensor_messages.hpp"

namespace redbee::mavlink {

/// The body (forward, right, down) against north, east, down: first yaw, then pitch, then roll.
struct Attitude {
  static constexpr uint32_t kId = 30;
  static constexpr std::string_view kName = "ATTITUDE";
  uint32_t time_boot_ms = 0;
  float roll = 0, pitch = 0, yaw = 0;                 ///< rad
  float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< rad/s
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("roll", m.roll);
    v("pitch", m.pitch);
    v("yaw", m.yaw);
    v("rollspeed", m.rollspeed);
    v("pitchspeed", m.pitchspeed);
    v("yawspeed", m.yawspeed);
  }
};

inline AttitudeQuaternion quaternionOf(const Attitude& m) {
  const Eigen::Quaternionf q = Eigen::AngleAxisf(m.yaw, Eigen::Vector3f::UnitZ()) *
                               Eigen::AngleAxisf(m.pitch, Eigen::Vector3f::UnitY()) *
                               Eigen::AngleAxisf(m.roll, Eigen::Vector3f::UnitX());
  return {m.time_boot_ms, q.w(), q.x(), q.y(), q.z(), m.rollspeed, m.pitchspeed, m.yawspeed, {}};
}

}  // namespace redbee::mavlink
