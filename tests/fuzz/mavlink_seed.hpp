// The seed of mavlink_fuzz.
#pragma once

#include <cstdint>
#include <vector>

#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"

namespace redbee::fuzz {

/// A second of an autopilot that answers TIMESYNC at once, as mavlink_fuzz counts the time.
inline std::vector<uint8_t> mavlinkSeed() {
  namespace mav = redbee::mavlink;
  mav::Encoder autopilot(1, 1);
  std::vector<uint8_t> seed{0};
  const auto append = [&](const mav::Bytes& frame, uint8_t milliseconds) {
    seed.push_back(static_cast<uint8_t>(0x80 | milliseconds));
    seed.push_back(0);
    seed.push_back(static_cast<uint8_t>(frame.size()));
    seed.insert(seed.end(), frame.begin(), frame.end());
  };
  append(autopilot.encode(mav::Heartbeat{0, 2, 12, 81, 4, 3}), 0);
  for (int64_t i = 0; i < 10; ++i) {
    const int64_t now_ns = 50'000'000'000 + i * 100'000'000;
    append(autopilot.encode(mav::Timesync{now_ns - 7'000'000'000, now_ns, 1, 191}), i == 0 ? 0 : 100);
    const auto device_ms = static_cast<uint32_t>(now_ns / 1'000'000 - 7000);
    mav::HighresImu imu;
    imu.time_usec = uint64_t{device_ms} * 1000;
    imu.zacc = -9.81F;
    imu.fields_updated = 0xffff;
    append(autopilot.encode(imu), 0);
    append(autopilot.encode(mav::AttitudeQuaternion{device_ms}), 0);
    append(autopilot.encode(mav::DistanceSensor{device_ms, 20, 4000, 500, 0, 0, 25}), 0);
    append(autopilot.encode(mav::GimbalDeviceAttitudeStatus{device_ms, {1, 0, 0, 0}, 0, 0, 0, 0, 32}), 0);
  }
  return seed;
}

}  // namespace redbee::fuzz
