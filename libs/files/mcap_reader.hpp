// Reads the messages of an MCAP file in the order of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "redbee/files/byte_view.hpp"
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

/// Chunks without compression, of zstd and lz4. CRCs of chunks are checked where the file has them. The
/// index is not used, so that a file whose recording was cut short is read as far as it goes.
class McapReader {
 public:
  /// Throws InputError if it is no MCAP file.
  explicit McapReader(std::filesystem::path path);

  /// Calls back for every message, from the beginning, until it returns false. Reading ends at the first
  /// damage.
  void read(const std::function<bool(const McapMessage&)>& on_message);
  /// Of the latest read(): file, place and what is wrong; empty if nothing is.
  const std::string& damage() const { return damage_; }

 private:
  struct Chunk;
  using OnMessage = std::function<bool(const McapMessage&)>;
  enum class Next { kGoOn, kStop };

  Next readRecord(const OnMessage& on_message);
  Next readChunk(const std::vector<uint8_t>& content, const OnMessage& on_message);
  Next takeRecord(uint8_t operation, ByteView content, const OnMessage& on_message);
  void takeChannel(ByteView content);
  void takeSchema(ByteView content);
  Next takeMessage(ByteView content, const OnMessage& on_message) const;

  std::filesystem::path path_;
  std::ifstream file_;
  uint64_t size_ = 0;
  uint64_t position_ = 0;
  std::map<uint16_t, McapSchema> schemas_;
  std::map<uint16_t, McapChannel> channels_;
  std::string damage_;
};

}  // namespace redbee
