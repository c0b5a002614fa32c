// The seeds of targets_fuzz and ground_link_fuzz.
#pragma once

#include <cstdint>
#include <vector>

#include "redbee/bus/codec.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/tracking_messages.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::fuzz {

/// A second in which the walker stops, as targets_fuzz counts the channels.
inline std::vector<uint8_t> targetsSeed(bool has_gimbal) {
  std::vector<uint8_t> seed;
  const auto append = [&](uint8_t channel, const auto& message) {
    const std::vector<uint8_t> data = encodeMessage(message);
    const size_t length = data.size() - kHashBytes;
    seed.push_back(channel);
    seed.push_back(static_cast<uint8_t>(length >> 8));
    seed.push_back(static_cast<uint8_t>(length & 255));
    seed.insert(seed.end(), data.begin() + kHashBytes, data.end());
  };
  test::TargetFlight flight;
  flight.walks_s = 0.3;
  flight.reported_s = 0.4;
  for (int k = 0; k < 6; ++k) {
    const double t = k * 0.1;
    const int64_t utime = 1'000'000'000 + k * 100'000;
    append(1, test::TargetFlight::pose(utime + 20'000, t, k % 2 == 0));
    append(2, test::TargetFlight::altimeter(utime + 20'000));
    gimbal_t gimbal{};
    gimbal.utime = utime + 20'000;
    gimbal.has_body = 1;
    gimbal.quat_body[0] = 1;
    append(3, gimbal);
    append(0, flight.detections(utime, t, k));
  }
  if (has_gimbal) seed.front() = 0x83;  // the same channel, of five
  return seed;
}

/// A pick by a point, by a rectangle, a stop, requests and rates, as ground_link_fuzz reads them.
inline std::vector<uint8_t> groundLinkSeed() {
  namespace command = mavlink::camera_command;
  mavlink::Encoder station(255, 190);
  std::vector<uint8_t> seed;
  const auto append = [&](uint16_t id, const std::array<float, 7>& param) {
    const mavlink::Bytes frame = station.encode(mavlink::CommandLong{param, id, 1, 100, 0});
    seed.push_back(0x80 | 30);
    seed.push_back(0);
    seed.push_back(static_cast<uint8_t>(frame.size()));
    seed.insert(seed.end(), frame.begin(), frame.end());
  };
  append(command::kTrackPoint, {0.15F, 0.15F, 0});
  append(command::kTrackRectangle, {0.45F, 0.45F, 0.65F, 0.65F});
  append(command::kStopTracking, {});
  append(command::kRequestMessage, {259});
  append(command::kSetMessageInterval, {276, 100'000});
  append(command::kStopMti, {});
  return seed;
}

}  // namespace redbee::fuzz
