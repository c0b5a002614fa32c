// Messages as published by a vehicle's drivers.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/inertial/mount_track.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"

namespace redbee::test {

inline ins_t message(const ImuSample& sample) {
  ins_t m{};
  m.utime = toUtime(sample.time);
  for (int i = 0; i < 3; ++i) {
    m.gyro[i] = sample.gyro(i);
    m.accel[i] = sample.accel(i);
  }
  return m;
}
inline altimeter_t message(const AltitudeSample& sample) {
  return {toUtime(sample.time), sample.height_m, sample.sigma_m};
}

/// Against the body alone, as a message of redbee-autopilot has it.
inline gimbal_t message(const MountSample& sample) {
  gimbal_t m{};
  m.utime = toUtime(sample.time);
  m.has_body = 1;
  m.quat_body[0] = sample.q_IM.w();
  for (int i = 0; i < 3; ++i) m.quat_body[i + 1] = sample.q_IM.vec()(i);
  return m;
}

/// Of a lens of this focal length [px] at rest, in an image of this width.
inline lens_t message(const LensSample& sample, double focal_px, int width) {
  lens_t m{};
  m.utime = toUtime(sample.time);
  m.has_focal_length = 1;
  m.focal_length = sample.zoom * focal_px;
  m.width = width;
  return m;
}

/// One message of a sensor, encoded.
struct SensorMessage {
  int64_t utime = 0;  ///< us
  std::string channel;
  std::vector<uint8_t> data;
};

inline SensorMessage encoded(const image_t& m) { return {m.utime, "CAMERA", encodeMessage(m)}; }
inline SensorMessage encoded(const ins_t& m) { return {m.utime, "IMU", encodeMessage(m)}; }
inline SensorMessage encoded(const gimbal_t& m) { return {m.utime, "GIMBAL", encodeMessage(m)}; }
inline SensorMessage encoded(const lens_t& m) { return {m.utime, "LENS", encodeMessage(m)}; }
inline SensorMessage encoded(const altimeter_t& m) { return {m.utime, "ALTIMETER", encodeMessage(m)}; }

}  // namespace redbee::test
