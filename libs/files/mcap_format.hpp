// MCAP, the container of rosbag2 and Foxglove (mcap.dev/spec): magic, then records of one byte of operation
// code, eight of length and the content, then magic. Numbers are little-endian; a string is four bytes of
// length and UTF-8.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace redbee {

constexpr std::array<uint8_t, 8> kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class McapRecord : uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kAttachment = 9,
  kAttachmentIndex = 10,
  kStatistics = 11,
  kMetadata = 12,
  kMetadataIndex = 13,
  kSummaryOffset = 14,
  kDataEnd = 15,
};

struct McapSchema {
  std::string name;      ///< "sensor_msgs/msg/Imu"
  std::string encoding;  ///< "ros2msg"
  std::string text;
};

}  // namespace redbee
