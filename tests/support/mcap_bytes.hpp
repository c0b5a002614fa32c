// Records of MCAP, byte by byte, by the format's specification.
#pragma once

#include <zlib.h>

#include <string>

#include "redbee/files/mcap_format.hpp"

namespace redbee::test {

inline std::string little(uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
  return out;
}
inline std::string mcapString(const std::string& text) { return little(text.size(), 4) + text; }
inline std::string mcapRecord(McapRecord kind, const std::string& content) {
  return little(static_cast<uint64_t>(kind), 1) + little(content.size(), 8) + content;
}
inline std::string mcapMagic() { return {kMcapMagic.begin(), kMcapMagic.end()}; }
inline std::string mcapHeader() {
  return mcapMagic() + mcapRecord(McapRecord::kHeader, mcapString("ros2") + mcapString(""));
}
inline std::string mcapEnd() {
  return mcapRecord(McapRecord::kDataEnd, std::string(4, '\0')) +
         mcapRecord(McapRecord::kFooter, std::string(20, '\0')) + mcapMagic();
}
inline std::string mcapSchema(uint16_t id, const std::string& name) {
  return mcapRecord(McapRecord::kSchema,
                    little(id, 2) + mcapString(name) + mcapString("ros2msg") + mcapString(""));
}
inline std::string mcapChannel(uint16_t id, uint16_t schema, const std::string& topic) {
  return mcapRecord(McapRecord::kChannel, little(id, 2) + little(schema, 2) + mcapString(topic) +
                                              mcapString("cdr") + mcapString(""));
}
inline std::string mcapMessage(uint16_t channel, uint64_t log_ns, const std::string& data) {
  return mcapRecord(McapRecord::kMessage,
                    little(channel, 2) + little(0, 4) + little(log_ns, 8) + little(log_ns, 8) + data);
}
/// Neither compressed nor, where `has_crc` is false, protected.
inline std::string mcapChunk(const std::string& records, bool has_crc = true) {
  const uint64_t crc =
      has_crc ? crc32(0, reinterpret_cast<const Bytef*>(records.data()), static_cast<uInt>(records.size()))
              : 0;
  return mcapRecord(McapRecord::kChunk, little(0, 8) + little(1, 8) + little(records.size(), 8) +
                                            little(crc, 4) + mcapString("") + little(records.size(), 8) +
                                            records);
}

}  // namespace redbee::test
