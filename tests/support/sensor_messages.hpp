// Messages as published by a vehicle's drivers.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/ins_t.hpp"

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

/// One message of a sensor, encoded.
struct SensorMessage {
  int64_t utime = 0;  ///< us
  std::string channel;
  std::vector<uint8_t> data;
};

inline SensorMessage encoded(const image_t& m) { return {m.utime, "CAMERA", encodeMessage(m)}; }
inline SensorMessage encoded(const ins_t& m) { return {m.utime, "IMU", encodeMessage(m)}; }
inline SensorMessage encoded(const altimeter_t& m) { return {m.utime, "ALTIMETER", encodeMessage(m)}; }

}  // namespace redbee::test
