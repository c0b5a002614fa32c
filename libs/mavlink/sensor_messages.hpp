// The messages of sensors and of the autopilot's estimator; see messages.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace redbee::mavlink {

/// Body axes forward, right, down; accelerometers measure specific force: at rest, level, zacc = -9.81.
struct HighresImu {
  static constexpr uint32_t kId = 105;
  static constexpr std::string_view kName = "HIGHRES_IMU";
  static constexpr uint16_t kAccelAndGyro = 0x3f;  ///< of `fields_updated`
  uint64_t time_usec = 0;
  float xacc = 0, yacc = 0, zacc = 0;     ///< m/s^2
  float xgyro = 0, ygyro = 0, zgyro = 0;  ///< rad/s
  float xmag = 0, ymag = 0, zmag = 0;     ///< gauss
  float abs_pressure = 0;                 ///< hPa
  float diff_pressure = 0;
  float pressure_alt = 0;  ///< m
  float temperature = 0;
  uint16_t fields_updated = 0;
  uint8_t id = 0;  ///< 0: the first IMU
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_usec", m.time_usec);
    v("xacc", m.xacc);
    v("yacc", m.yacc);
    v("zacc", m.zacc);
    v("xgyro", m.xgyro);
    v("ygyro", m.ygyro);
    v("zgyro", m.zgyro);
    v("xmag", m.xmag);
    v("ymag", m.ymag);
    v("zmag", m.zmag);
    v("abs_pressure", m.abs_pressure);
    v("diff_pressure", m.diff_pressure);
    v("pressure_alt", m.pressure_alt);
    v("temperature", m.temperature);
    v("fields_updated", m.fields_updated);
    v.extensions();
    v("id", m.id);
  }
};

/// Raw by definition; ArduPilot fills it with mG and mrad/s (GCS_MAVLINK::send_raw_imu), PX4 does not send
/// it.
struct RawImu {
  static constexpr uint32_t kId = 27;
  static constexpr std::string_view kName = "RAW_IMU";
  uint64_t time_usec = 0;
  int16_t xacc = 0, yacc = 0, zacc = 0;
  int16_t xgyro = 0, ygyro = 0, zgyro = 0;
  int16_t xmag = 0, ymag = 0, zmag = 0;
  uint8_t id = 0;
  int16_t temperature = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_usec", m.time_usec);
    v("xacc", m.xacc);
    v("yacc", m.yacc);
    v("zacc", m.zacc);
    v("xgyro", m.xgyro);
    v("ygyro", m.ygyro);
    v("zgyro", m.zgyro);
    v("xmag", m.xmag);
    v("ymag", m.ymag);
    v("zmag", m.zmag);
    v.extensions();
    v("id", m.id);
    v("temperature", m.temperature);
  }
};

struct ScaledImu2 {
  static constexpr uint32_t kId = 116;
  static constexpr std::string_view kName = "SCALED_IMU2";
  uint32_t time_boot_ms = 0;
  int16_t xacc = 0, yacc = 0, zacc = 0;     ///< mG
  int16_t xgyro = 0, ygyro = 0, zgyro = 0;  ///< mrad/s
  int16_t xmag = 0, ymag = 0, zmag = 0;
  int16_t temperature = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("xacc", m.xacc);
    v("yacc", m.yacc);
    v("zacc", m.zacc);
    v("xgyro", m.xgyro);
    v("ygyro", m.ygyro);
    v("zgyro", m.zgyro);
    v("xmag", m.xmag);
    v("ymag", m.ymag);
    v("zmag", m.zmag);
    v.extensions();
    v("temperature", m.temperature);
  }
};

/// The rotation from body (forward, right, down) to north, east, down.
struct AttitudeQuaternion {
  static constexpr uint32_t kId = 31;
  static constexpr std::string_view kName = "ATTITUDE_QUATERNION";
  uint32_t time_boot_ms = 0;
  float q1 = 1, q2 = 0, q3 = 0, q4 = 0;  ///< w x y z
  float rollspeed = 0, pitchspeed = 0, yawspeed = 0;
  std::array<float, 4> repr_offset_q{};
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("q1", m.q1);
    v("q2", m.q2);
    v("q3", m.q3);
    v("q4", m.q4);
    v("rollspeed", m.rollspeed);
    v("pitchspeed", m.pitchspeed);
    v("yawspeed", m.yawspeed);
    v.extensions();
    v("repr_offset_q", m.repr_offset_q);
  }
};

struct LocalPositionNed {
  static constexpr uint32_t kId = 32;
  static constexpr std::string_view kName = "LOCAL_POSITION_NED";
  uint32_t time_boot_ms = 0;
  float x = 0, y = 0, z = 0;     ///< m
  float vx = 0, vy = 0, vz = 0;  ///< m/s
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("x", m.x);
    v("y", m.y);
    v("z", m.z);
    v("vx", m.vx);
    v("vy", m.vy);
    v("vz", m.vz);
  }
};

struct GlobalPositionInt {
  static constexpr uint32_t kId = 33;
  static constexpr std::string_view kName = "GLOBAL_POSITION_INT";
  uint32_t time_boot_ms = 0;
  int32_t lat = 0, lon = 0;        ///< 1e-7 deg
  int32_t alt = 0;                 ///< mm above mean sea level
  int32_t relative_alt = 0;        ///< mm above home
  int16_t vx = 0, vy = 0, vz = 0;  ///< cm/s, north east down
  uint16_t hdg = 0;                ///< 0.01 deg
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("lat", m.lat);
    v("lon", m.lon);
    v("alt", m.alt);
    v("relative_alt", m.relative_alt);
    v("vx", m.vx);
    v("vy", m.vy);
    v("vz", m.vz);
    v("hdg", m.hdg);
  }
};

struct GpsRawInt {
  static constexpr uint32_t kId = 24;
  static constexpr std::string_view kName = "GPS_RAW_INT";
  uint64_t time_usec = 0;
  int32_t lat = 0, lon = 0;           ///< 1e-7 deg
  int32_t alt = 0;                    ///< mm above mean sea level
  uint16_t eph = 65535, epv = 65535;  ///< 0.01, dilution of precision
  uint16_t vel = 65535, cog = 65535;
  uint8_t fix_type = 0;  ///< GPS_FIX_TYPE; 3: three dimensions
  uint8_t satellites_visible = 255;
  int32_t alt_ellipsoid = 0;      ///< mm above WGS-84's ellipsoid; 0 from senders without extensions
  uint32_t h_acc = 0, v_acc = 0;  ///< mm; 0: unknown
  uint32_t vel_acc = 0;           ///< mm/s
  uint32_t hdg_acc = 0;           ///< 1e-5 deg
  uint16_t yaw = 0;
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_usec", m.time_usec);
    v("lat", m.lat);
    v("lon", m.lon);
    v("alt", m.alt);
    v("eph", m.eph);
    v("epv", m.epv);
    v("vel", m.vel);
    v("cog", m.cog);
    v("fix_type", m.fix_type);
    v("satellites_visible", m.satellites_visible);
    v.extensions();
    v("alt_ellipsoid", m.alt_ellipsoid);
    v("h_acc", m.h_acc);
    v("v_acc", m.v_acc);
    v("vel_acc", m.vel_acc);
    v("hdg_acc", m.hdg_acc);
    v("yaw", m.yaw);
  }
};

struct DistanceSensor {
  static constexpr uint32_t kId = 132;
  static constexpr std::string_view kName = "DISTANCE_SENSOR";
  static constexpr uint8_t kDownward = 25;  ///< of `orientation`: MAV_SENSOR_ROTATION_PITCH_270
  uint32_t time_boot_ms = 0;
  uint16_t min_distance = 0, max_distance = 0, current_distance = 0;  ///< cm
  uint8_t type = 0;
  uint8_t id = 0;
  uint8_t orientation = 0;
  uint8_t covariance = 255;  ///< cm^2; 255: unknown
  float horizontal_fov = 0, vertical_fov = 0;
  std::array<float, 4> quaternion{};
  uint8_t signal_quality = 0;  ///< percent; 0: unknown, 1: invalid
  template <typename M, typename V>
  static constexpr void visit(M& m, V& v) {
    v("time_boot_ms", m.time_boot_ms);
    v("min_distance", m.min_distance);
    v("max_distance", m.max_distance);
    v("current_distance", m.current_distance);
    v("type", m.type);
    v("id", m.id);
    v("orientation", m.orientation);
    v("covariance", m.covariance);
    v.extensions();
    v("horizontal_fov", m.horizontal_fov);
    v("vertical_fov", m.vertical_fov);
    v("quaternion", m.quaternion);
    v("signal_quality", m.signal_quality);
  }
};

}  // namespace redbee::mavlink
