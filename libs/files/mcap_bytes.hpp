// Records of MCAP in a file or in a chunk: their bytes, their fields, and where the next one is behind
// damage.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "redbee/files/byte_view.hpp"
#include "redbee/files/mcap_format.hpp"

namespace redbee {

constexpr uint64_t kMcapRecordHead = 9;              ///< bytes: operation code and length
constexpr uint64_t kLargestMcapRecord = 1ULL << 30;  ///< bytes; recorders make chunks of some megabytes

/// what() is part of a line.
class McapDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The fields of a record, in their order; each throws McapDamage at its end.
class McapFields {
 public:
  explicit McapFields(ByteView bytes) : bytes_(bytes) {}

  template <typename Unsigned>
  Unsigned number() {
    const ByteView raw = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (size_t i = 0; i < sizeof(Unsigned); ++i)
      value = static_cast<Unsigned>(value | static_cast<Unsigned>(raw.data[i]) << (8 * i));
    return value;
  }
  std::string string() {
    const ByteView text = take(number<uint32_t>());
    return {reinterpret_cast<const char*>(text.data), text.size};
  }
  ByteView take(uint64_t count);
  ByteView rest() const { return bytes_; }
  bool atEnd() const { return bytes_.size == 0; }

 private:
  ByteView bytes_;
};

class McapBytes {
 public:
  virtual ~McapBytes() = default;
  virtual uint64_t size() const = 0;
  /// `count` bytes from `place` on, as far as there are so many; valid until the next call.
  virtual ByteView at(uint64_t place, uint64_t count) = 0;
};

class McapMemory : public McapBytes {
 public:
  explicit McapMemory(ByteView bytes) : bytes_(bytes) {}
  uint64_t size() const override { return bytes_.size; }
  ByteView at(uint64_t place, uint64_t count) override;

 private:
  ByteView bytes_;
};

/// What cannot be read, as on a damaged disk, is zero.
class McapFile : public McapBytes {
 public:
  McapFile(std::ifstream& file, uint64_t size) : file_(file), size_(size) {}
  uint64_t size() const override { return size_; }
  ByteView at(uint64_t place, uint64_t count) override;

 private:
  std::ifstream& file_;
  uint64_t size_;
  uint64_t start_ = 0;  ///< of what is in the buffer
  std::vector<uint8_t> buffer_;
};

struct McapHead {
  uint8_t operation = 0;
  uint64_t length = 0;  ///< bytes of the content, which follows

  McapRecord kind() const { return static_cast<McapRecord>(operation); }
};

struct McapChunk {
  uint64_t size = 0;  ///< bytes, uncompressed
  uint32_t crc = 0;   ///< 0: none
  std::string compression;
  uint64_t compressed_size = 0;
  uint64_t head = 0;  ///< bytes before the compressed records
};

/// std::nullopt where the bytes end before it does.
std::optional<McapHead> mcapHeadAt(McapBytes& bytes, uint64_t place);
/// The start of a chunk's content; std::nullopt where it cannot be one. Its compressed records may be cut.
std::optional<McapChunk> mcapChunkAt(McapBytes& bytes, uint64_t place);
/// Whether the content at `place` is a chunk's to the byte, whatever its operation code says.
bool isWholeMcapChunk(McapBytes& bytes, uint64_t place, uint64_t length);
/// The first place at or after `place` where a record begins, as it and those that follow show; size() if
/// there is none.
uint64_t nextMcapRecord(McapBytes& bytes, uint64_t place);
bool isMcapRecordAt(McapBytes& bytes, uint64_t place);

}  // namespace redbee
