// Writes MCAP: chunks compressed by zstd, each with its index and CRC, and a summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "redbee/files/atomic_file.hpp"
#include "redbee/files/byte_view.hpp"
#include "redbee/files/mcap_format.hpp"

namespace redbee {

/// The file appears under its name on close(); without close() no file remains. Throws InputError if it
/// cannot be written.
class McapWriter {
 public:
  /// `profile`: "ros2" for CDR with ROS 2's definitions. `library`: who writes it.
  McapWriter(const std::filesystem::path& path, const std::string& profile, const std::string& library);

  /// The number of the channel. A schema that is there already is shared.
  uint16_t addChannel(const std::string& topic, const McapSchema& schema,
                      const std::string& message_encoding);
  /// `log_ns`: not negative.
  void write(uint16_t channel, int64_t log_ns, const std::vector<uint8_t>& message);
  void close();

 private:
  struct Channel {
    uint16_t schema = 0;
    std::string record;
    uint32_t sequence = 0;
    uint64_t messages = 0;
    bool is_in_file = false;
    std::string index;  ///< of the open chunk: time and offset of each message
  };
  struct ChunkIndex {
    uint64_t first_ns, last_ns, start, length, index_length, compressed_size, size;
    std::map<uint16_t, uint64_t> index_offsets;
  };

  void append(const std::string& bytes);
  void appendRecord(McapRecord kind, const std::string& content);
  void writeChannelOnce(Channel& channel);
  void closeChunk();
  void writeSummary();
  std::string statistics() const;

  AtomicFile file_;
  uint64_t position_ = 0;
  uint32_t crc_ = 0;                  ///< of what has been written since it was last 0
  std::vector<std::string> schemas_;  ///< records; the number is the place + 1
  std::vector<bool> schema_is_in_file_;
  std::vector<Channel> channels_;  ///< the number is the place + 1
  std::string chunk_;
  uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0;
  std::vector<ChunkIndex> chunks_;
};

}  // namespace redbee
