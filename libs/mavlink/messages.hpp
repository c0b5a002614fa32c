// The messages that are read or written, as message_definitions/v1.0/common.xml and minimal.xml of
// mavlink/mavlink define them (commit de1e078a3a, 2026-07): fields in wire order, units of the wire. A value
// that a sender does not know is the field's "invalid" there: NaN, 0 or the largest number.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace redbee::mavlink {

struct Heartbeat {
  static constexpr uint32_t kId = 0;
  static constexpr std::string_view kName = "HEARTBEAT";
  static constexpr uint8_t kArduPilot = 3, kPx4 = 12;  ///< of `autopilot`
  uint32_t custom_mode = 0;
  uint8_t type = 0;       ///< MAV_TYPE
  uint8_t autopilot = 0;  ///< MAV_AUTOPILOT
  uint8_t base_mode = 0;
  uint8_t system_status = 0;    ///< MAV_STATE
  uint8_t mavlink_version = 3;  ///< of the definitions, the same for MAVLink 1 and 2
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("custom_mode", m.custom_mode);
    v("type", m.type);
    v("autopilot", m.autopilot);
    v("base_mode", m.base_mode);
    v("system_status", m.system_status);
    v("mavlink_version", m.mavlink_version);
  }
};

/// Asks (tc1 = 0), or answers with the request's ts1.
struct Timesync {
  static constexpr uint32_t kId = 111;
  static constexpr std::string_view kName = "TIMESYNC";
  int64_t tc1 = 0;            ///< ns, clock of who answers
  int64_t ts1 = 0;            ///< ns, clock of who asks
  uint8_t target_system = 0;  ///< of who asks; 0 from old senders
  uint8_t target_component = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("tc1", m.tc1);
    v("ts1", m.ts1);
    v.extensions();
    v("target_system", m.target_system);
    v("target_component", m.target_component);
  }
};

struct CommandLong {
  static constexpr uint32_t kId = 76;
  static constexpr std::string_view kName = "COMMAND_LONG";
  static constexpr uint16_t kSetMessageInterval =
      511;  ///< param1: message; param2: us; MAV_CMD_SET_MESSAGE_INTERVAL
  static constexpr uint16_t kRequestMessage = 512;  ///< param1: message; MAV_CMD_REQUEST_MESSAGE
  std::array<float, 7> param{};
  uint16_t command = 0;
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  uint8_t confirmation = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("param1", m.param[0]);
    v("param2", m.param[1]);
    v("param3", m.param[2]);
    v("param4", m.param[3]);
    v("param5", m.param[4]);
    v("param6", m.param[5]);
    v("param7", m.param[6]);
    v("command", m.command);
    v("target_system", m.target_system);
    v("target_component", m.target_component);
    v("confirmation", m.confirmation);
  }
};

/// The same command with a place in integers, which some ground stations use for all; see asLong().
struct CommandInt {
  static constexpr uint32_t kId = 75;
  static constexpr std::string_view kName = "COMMAND_INT";
  std::array<float, 4> param{};
  int32_t x = 0;  ///< param5, scaled by the frame's rule
  int32_t y = 0;  ///< param6
  float z = 0;    ///< param7
  uint16_t command = 0;
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  uint8_t frame = 0;
  uint8_t current = 0;
  uint8_t autocontinue = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("param1", m.param[0]);
    v("param2", m.param[1]);
    v("param3", m.param[2]);
    v("param4", m.param[3]);
    v("x", m.x);
    v("y", m.y);
    v("z", m.z);
    v("command", m.command);
    v("target_system", m.target_system);
    v("target_component", m.target_component);
    v("frame", m.frame);
    v("current", m.current);
    v("autocontinue", m.autocontinue);
  }
  /// Of a command that uses its first four parameters only, as all of a camera that tracks do.
  CommandLong asLong() const {
    return {{param[0], param[1], param[2], param[3]}, command, target_system, target_component, 0};
  }
};

struct CommandAck {
  static constexpr uint32_t kId = 77;
  static constexpr std::string_view kName = "COMMAND_ACK";
  uint16_t command = 0;
  uint8_t result = 0;  ///< MAV_RESULT; 0 is accepted
  uint8_t progress = 0;
  int32_t result_param2 = 0;
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("command", m.command);
    v("result", m.result);
    v.extensions();
    v("progress", m.progress);
    v("result_param2", m.result_param2);
    v("target_system", m.target_system);
    v("target_component", m.target_component);
  }
};

struct MountOrientation {
  static constexpr uint32_t kId = 265;
  static constexpr std::string_view kName = "MOUNT_ORIENTATION";
  uint32_t time_boot_ms = 0;
  float roll = 0;          ///< deg, against the horizon
  float pitch = 0;         ///< deg, against the horizon
  float yaw = 0;           ///< deg, against the vehicle's heading
  float yaw_absolute = 0;  ///< deg, from north
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("roll", m.roll);
    v("pitch", m.pitch);
    v("yaw", m.yaw);
    v.extensions();
    v("yaw_absolute", m.yaw_absolute);
  }
};

struct GimbalDeviceAttitudeStatus {
  static constexpr uint32_t kId = 285;
  static constexpr std::string_view kName = "GIMBAL_DEVICE_ATTITUDE_STATUS";
  static constexpr uint16_t kYawLock = 16, kYawInVehicleFrame = 32, kYawInEarthFrame = 64;  ///< of `flags`
  uint32_t time_boot_ms = 0;
  std::array<float, 4> q{};  ///< w x y z, gimbal (forward right down) to the frame that `flags` name
  float angular_velocity_x = 0;
  float angular_velocity_y = 0;
  float angular_velocity_z = 0;
  uint32_t failure_flags = 0;
  uint16_t flags = 0;
  uint8_t target_system = 0;
  uint8_t target_component = 0;
  float delta_yaw = 0;  ///< rad
  float delta_yaw_velocity = 0;
  uint8_t gimbal_device_id = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("q", m.q);
    v("angular_velocity_x", m.angular_velocity_x);
    v("angular_velocity_y", m.angular_velocity_y);
    v("angular_velocity_z", m.angular_velocity_z);
    v("failure_flags", m.failure_flags);
    v("flags", m.flags);
    v("target_system", m.target_system);
    v("target_component", m.target_component);
    v.extensions();
    v("delta_yaw", m.delta_yaw);
    v("delta_yaw_velocity", m.delta_yaw_velocity);
    v("gimbal_device_id", m.gimbal_device_id);
  }
};

}  // namespace redbee::mavlink
