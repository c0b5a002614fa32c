// Builds GPMF payloads as a camera writes them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "redbee/importers/data_track.hpp"
#include "redbee/importers/gpmf.hpp"

namespace redbee::test {

using Bytes = std::vector<uint8_t>;

inline void append(Bytes& to, const Bytes& what) { to.insert(to.end(), what.begin(), what.end()); }

inline Bytes bigEndian(uint64_t value, int bytes) {
  Bytes out;
  for (int shift = 8 * bytes - 8; shift >= 0; shift -= 8) out.push_back(static_cast<uint8_t>(value >> shift));
  return out;
}

inline Bytes record(const std::string& key, char type, size_t sample_size, size_t count, Bytes data) {
  Bytes out(key.begin(), key.end());
  out.push_back(static_cast<uint8_t>(type));
  out.push_back(static_cast<uint8_t>(sample_size));
  append(out, bigEndian(count, 2));
  while (data.size() % 4 != 0) data.push_back(0);
  append(out, data);
  return out;
}

inline Bytes container(const std::string& key, const Bytes& inside) {
  return record(key, 0, 1, inside.size(), inside);
}
inline Bytes text(const std::string& key, const std::string& content) {
  return record(key, 'c', content.size(), 1, Bytes(content.begin(), content.end()));
}
inline Bytes shorts(const std::vector<int>& values) {
  Bytes out;
  for (const int value : values) append(out, bigEndian(static_cast<uint16_t>(value), 2));
  return out;
}

/// One sensor's stream: `total` samples after this payload, `count` of them in it, all with the same reading.
inline Bytes stream(const std::string& key, const std::string& unit, int scale, int total, int count,
                    const std::vector<int>& reading, const Bytes& extra = {}) {
  std::vector<int> values;
  for (int k = 0; k < count; ++k) values.insert(values.end(), reading.begin(), reading.end());
  Bytes inside = record("TSMP", 'L', 4, 1, bigEndian(static_cast<uint64_t>(total), 4));
  append(inside, text("SIUN", unit));
  append(inside, record("SCAL", 's', 2, 1, shorts({scale})));
  append(inside, extra);
  append(inside, record(key, 's', 6, static_cast<size_t>(count), shorts(values)));
  return container("STRM", inside);
}

inline Bytes payload(int index, int gyro_count, const std::string& gyro_unit = "rad/s",
                     const Bytes& gyro_extra = {}) {
  Bytes inside =
      stream("ACCL", "m/s\xB2", 100, (index + 1) * gyro_count / 2, gyro_count / 2, {981, 100, -200});
  append(inside, stream("GYRO", gyro_unit, 1000, (index + 1) * gyro_count, gyro_count, {1000, 2000, 3000},
                        gyro_extra));
  return container("DEVC", inside);
}

inline std::vector<DataPacket> packets(int count, const std::string& unit = "rad/s",
                                       const Bytes& extra = {}) {
  std::vector<DataPacket> out;
  out.reserve(static_cast<size_t>(count));
  for (int k = 0; k < count; ++k) out.push_back({1.0 * k, 1.0, payload(k, 400, unit, extra)});
  return out;
}

}  // namespace redbee::test
