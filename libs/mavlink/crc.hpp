// The checksum of MAVLink: CRC-16/MCRF4XX (reflected polynomial 0x8408, start 0xFFFF),
// mavlink.io/en/guide/serialization.html.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace redbee::mavlink {

inline constexpr uint16_t kCrcStart = 0xffff;

constexpr uint16_t crcOf(uint8_t byte, uint16_t crc) {
  const auto low = static_cast<uint8_t>(byte ^ (crc & 0xff));
  const auto t = static_cast<uint8_t>(low ^ (low << 4));
  return static_cast<uint16_t>((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4));
}
constexpr uint16_t crcOf(std::string_view text, uint16_t crc) {
  for (const char c : text) crc = crcOf(static_cast<uint8_t>(c), crc);
  return crc;
}
inline uint16_t crcOf(const uint8_t* data, size_t size, uint16_t crc) {
  for (size_t i = 0; i < size; ++i) crc = crcOf(data[i], crc);
  return crc;
}

}  // namespace redbee::mavlink
