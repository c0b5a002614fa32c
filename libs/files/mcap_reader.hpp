// Reads the messages of an MCAP file in the order of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "redbee/files/byte_view.hpp"
#include "redbee/files/mcap_bytes.hpp"
#include "redbee/files/mcap_format.hpp"

namespace redbee {

struct McapChannel {
  std::string topic;
  std::string message_encoding;  ///< "cdr", "ros1", "json", "protobuf", ...
  McapSchema schema;             ///< without its text
};

struct McapMessage {
  const McapChannel* channel = nullptr;
  int64_t log_ns = 0;
  ByteView data;  ///< valid during the call
};

using McapCounts = std::vector<std::pair<McapChannel, int64_t>>;

/// Chunks without compression, of zstd and lz4. CRCs of chunks are checked where the file has them. Messages
/// are found without the index, so that a file whose recording was cut short is read, too.
class McapReader {
 public:
  /// Throws InputError if it is no MCAP file.
  explicit McapReader(std::filesystem::path path);

  /// Calls back for every message, from the beginning, until it returns false. Damage is passed over: what is
  /// whole behind it comes, also within a chunk. A message in a chunk whose CRC is wrong may be the damaged
  /// one.
  void read(const std::function<bool(const McapMessage&)>& on_message);
  /// Of the latest read(): file, first place and what is wrong; empty if nothing is.
  const std::string& damage() const { return damage_; }
  /// Number of messages of every channel that has some, as the file's end states it; std::nullopt where it
  /// does not, or where that part is damaged.
  std::optional<McapCounts> summary();

 private:
  using OnMessage = std::function<bool(const McapMessage&)>;
  enum class Next { kGoOn, kStop };
  struct KnownChannel {
    McapChannel channel;
    bool is_damaged = false;  ///< it may be: from a chunk whose CRC is wrong
  };

  void reset();
  /// Of the file, or of a chunk.
  Next readRecords(McapBytes& bytes, uint64_t place, const OnMessage& on_message);
  Next readRecord(McapBytes& bytes, uint64_t place, const McapHead& head, const OnMessage& on_message);
  Next readChunk(McapBytes& bytes, uint64_t place, const McapChunk& chunk, const OnMessage& on_message);
  Next takeRecord(const McapHead& head, ByteView content, const OnMessage& on_message);
  void takeChannel(ByteView content);
  void takeSchema(ByteView content);
  Next takeMessage(ByteView content, const OnMessage& on_message) const;
  /// The place after damage at `place`; reads the chunk there as far as it goes.
  uint64_t passOver(McapBytes& bytes, uint64_t place, const OnMessage& on_message, Next& next);
  /// Its records; std::nullopt where the footer does not point to one that is whole.
  std::optional<ByteView> summaryPart(McapBytes& bytes) const;
  void takeStatistics(ByteView content, McapCounts& counts) const;
  void note(uint64_t place, const std::string& what);

  std::filesystem::path path_;
  std::ifstream file_;
  uint64_t size_ = 0;
  std::map<uint16_t, McapSchema> schemas_;
  std::map<uint16_t, KnownChannel> channels_;
  std::optional<uint64_t> chunk_;  ///< place of the one that is being read
  bool is_in_damaged_chunk_ = false;
  std::string damage_;
};

}  // namespace redbee
