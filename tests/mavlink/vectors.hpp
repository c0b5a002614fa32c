// Frames as an independent implementation wrote them (node-mavlink 2.3.0).
#pragma once

#include <string_view>

#include "redbee/mavlink/frame.hpp"

namespace redbee::mavlink::vectors {

// Sender 1/1. HIGHRES_IMU: time 123456789 us, accel 0.5 -0.25 -9.75, gyro 0.125 -0.0625 0.03125, mag 0.25 0.5
// -0.5, 1013.25 hPa, altitude 12.5 m, 30 degrees, fields_updated 0xffff, id 0.
inline constexpr std::string_view kImu2 =
    "fd3e000007010169000015cd5b07000000000000003f000080be00001cc10000003e000080bd0000003d0000803e0000003f0000"
    "00bf00507d44"
    "00000000000048410000f041ffff4b0c";
inline constexpr std::string_view kImu1 =
    "fe3f0801016915cd5b07000000000000003f000080be00001cc10000003e000080bd0000003d0000803e0000003f000000bf0050"
    "7d4400000000"
    "000048410000f041ffff006c02";
// HEARTBEAT: type 2, autopilot 12, base mode 81, status 4.
inline constexpr std::string_view kHeartbeat2 = "fd09000009010100000000000000020c510403cfaa";
inline constexpr std::string_view kHeartbeat1 = "fe090a01010000000000020c51040336a5";
// The same, signed: link 3, 2026-01-01.
inline constexpr std::string_view kSignedHeartbeat =
    "fd0901000c010100000000000000020c5104035af40300e03cd6921fba7197cbdf19";
inline constexpr std::string_view kKey = "2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b";
// GIMBAL_DEVICE_ATTITUDE_STATUS: 1000 ms, q 0.5 0.5 -0.5 0.5, flags 32, delta_yaw 1.5; zeros left out at the
// end.
inline constexpr std::string_view kGimbal =
    "fd2c00000b01011d0100e80300000000003f0000003f000000bf0000003f00000000000000000000000000000000200000000000"
    "c03f2863";
// Sender 1/1. TIMESYNC: tc1 0, ts1 1234567890123, to 1/1. COMMAND_LONG: 511 of 105, 5000 us, to 1/1.
inline constexpr std::string_view kTimesync = "fd1200000001016f00000000000000000000cb04fb711f0100000101115b";
inline constexpr std::string_view kCommand =
    "fd2000000101014c00000000d24200409c450000000000000000000000000000000000000000ff0101011a66";
// Sender 1/191. HEARTBEAT: type 18, autopilot 8, status 4; and the same, signed: link 0, 2026-01-01.
inline constexpr std::string_view kOurHeartbeat = "fd0900000001bf000000000000001208000403aec6";
inline constexpr std::string_view kOurSignedHeartbeat =
    "fd0901000001bf000000000000001208000403493e0000e03cd6921f1ba5d27fa437";

inline Bytes bytesOf(std::string_view hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  Bytes bytes;
  for (size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<uint8_t>(16 * digit(hex[i]) + digit(hex[i + 1])));
  }
  return bytes;
}

}  // namespace redbee::mavlink::vectors
