// The seed of gpmf_fuzz.
#pragma once

#include <cstdint>
#include <string>

namespace redbee::fuzz {

inline std::string bigEndian(uint64_t value, int bytes) {
  std::string out;
  for (int shift = 8 * bytes - 8; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift);
  return out;
}
inline std::string gpmf(const std::string& key, char type, size_t size, size_t count, std::string data) {
  data.resize((data.size() + 3) / 4 * 4);
  return key + type + bigEndian(size, 1) + bigEndian(count, 2) + data;
}
inline std::string gpmfStream(const std::string& key, const std::string& unit) {
  std::string samples;
  for (int i = 0; i < 12; ++i) samples += bigEndian(static_cast<uint64_t>(100 + i), 2);
  const std::string inside = gpmf("TSMP", 'L', 4, 1, bigEndian(4, 4)) +
                             gpmf("SIUN", 'c', unit.size(), 1, unit) +
                             gpmf("SCAL", 's', 2, 1, bigEndian(418, 2)) + gpmf("ORIO", 'c', 1, 3, "ZXY") +
                             gpmf(key, 's', 6, 4, samples);
  return gpmf("STRM", '\0', 1, inside.size(), inside);
}

/// Two payloads of gyro and accelerometer.
inline std::string gpmfSeed() {
  const std::string streams = gpmfStream("GYRO", "rad/s") + gpmfStream("ACCL", "m/s\xb2");
  const std::string payload = gpmf("DEVC", '\0', 1, streams.size(), streams);
  return payload + "\n%%\n" + payload;
}

}  // namespace redbee::fuzz
