#include "redbee/files/mcap_bytes.hpp"

#include <algorithm>

namespace redbee {
namespace {

constexpr uint64_t kMessageHead = 2 + 4 + 8 + 8;  ///< bytes before a message's data
constexpr uint64_t kSmallHead = 64;               ///< bytes that hold a chunk's fields

/// Whether `length` bytes at `place` are these: fields of fixed size, then `texts` counted ones, no more.
bool isMadeOf(McapBytes& bytes, uint64_t place, uint64_t length, uint64_t fixed, int texts) {
  uint64_t at = fixed;
  for (int i = 0; i < texts; ++i) {
    if (at + 4 > length) return false;
    McapFields count(bytes.at(place + at, 4));
    at += 4 + count.number<uint32_t>();
  }
  return at == length;
}

/// Whether the content fits what the operation code says. `is_first`: nothing vouches for it yet, so that
/// only records that are read count, and those that end a file.
bool isConsistent(McapBytes& bytes, uint64_t place, const McapHead& head, bool is_first) {
  constexpr uint64_t kEndLength = 4, kFooterLength = 20;
  switch (head.kind()) {
    case McapRecord::kSchema:
      return isMadeOf(bytes, place, head.length, 2, 3);
    case McapRecord::kChannel:
      return isMadeOf(bytes, place, head.length, 4, 3);
    case McapRecord::kMessage:
      return head.length >= kMessageHead;
    case McapRecord::kChunk:
      return isWholeMcapChunk(bytes, place, head.length);
    case McapRecord::kDataEnd:
      return head.length == kEndLength;
    case McapRecord::kFooter:
      return head.length == kFooterLength;
    default:
      return !is_first && head.operation != 0;
  }
}

}  // namespace

ByteView McapFields::take(uint64_t count) {
  if (count > bytes_.size) throw McapDamage("a record is shorter than its fields");
  const ByteView taken{bytes_.data, static_cast<size_t>(count)};
  bytes_ = {bytes_.data + count, bytes_.size - static_cast<size_t>(count)};
  return taken;
}

ByteView McapMemory::at(uint64_t place, uint64_t count) {
  const uint64_t from = std::min<uint64_t>(place, bytes_.size);
  return {bytes_.data + from, static_cast<size_t>(std::min<uint64_t>(count, bytes_.size - from))};
}

ByteView McapFile::at(uint64_t place, uint64_t count) {
  constexpr uint64_t kBlock = 64 << 10;
  const uint64_t from = std::min(place, size_);
  count = std::min(count, size_ - from);
  const bool is_here = from >= start_ && from + count <= start_ + buffer_.size();
  if (!is_here) {
    start_ = from;
    buffer_.assign(static_cast<size_t>(std::min(std::max(count, kBlock), size_ - from)), 0);
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(from));
    file_.read(reinterpret_cast<char*>(buffer_.data()), static_cast<std::streamsize>(buffer_.size()));
  }
  return {buffer_.data() + (from - start_), static_cast<size_t>(count)};
}

std::optional<McapHead> mcapHeadAt(McapBytes& bytes, uint64_t place) {
  const ByteView raw = bytes.at(place, kMcapRecordHead);
  if (raw.size < kMcapRecordHead) return std::nullopt;
  McapFields fields(raw);
  McapHead head;
  head.operation = fields.number<uint8_t>();
  head.length = fields.number<uint64_t>();
  return head;
}

std::optional<McapChunk> mcapChunkAt(McapBytes& bytes, uint64_t place) {
  constexpr size_t kLongestName = 8;  // "zstd", "lz4"
  const ByteView raw = bytes.at(place, kSmallHead);
  McapFields fields(raw);
  McapChunk chunk;
  try {
    fields.number<uint64_t>();  // first and last time
    fields.number<uint64_t>();
    chunk.size = fields.number<uint64_t>();
    chunk.crc = fields.number<uint32_t>();
    chunk.compression = fields.string();
    chunk.compressed_size = fields.number<uint64_t>();
  } catch (const McapDamage&) {
    return std::nullopt;
  }
  if (chunk.compression.size() > kLongestName) return std::nullopt;
  chunk.head = raw.size - fields.rest().size;
  return chunk;
}

bool isWholeMcapChunk(McapBytes& bytes, uint64_t place, uint64_t length) {
  const auto chunk = mcapChunkAt(bytes, place);
  return chunk && chunk->head < length && chunk->compressed_size == length - chunk->head;
}

bool isMcapRecordAt(McapBytes& bytes, uint64_t place) {
  // By chance, or in an image, one may seem to begin; not so many after one another.
  constexpr int kRecords = 4;
  for (int i = 0; i < kRecords; ++i) {
    const auto head = mcapHeadAt(bytes, place);
    if (!head) return i > 0;
    const uint64_t content = place + kMcapRecordHead;
    if (head->operation == 0 || head->length > kLargestMcapRecord) return false;
    if (head->length > bytes.size() - content) return i > 0;  // the last one is cut
    if (!isConsistent(bytes, content, *head, i == 0)) return false;
    if (head->kind() == McapRecord::kFooter) return true;
    place = content + head->length;
  }
  return true;
}

uint64_t nextMcapRecord(McapBytes& bytes, uint64_t place) {
  for (; place < bytes.size(); ++place) {
    if (isMcapRecordAt(bytes, place)) return place;
  }
  return bytes.size();
}

}  // namespace redbee
