#include "redbee/files/mcap_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <utility>

#include "redbee/files/decompress.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr uint64_t kLargestChunk = 512ULL << 20;  ///< bytes, uncompressed
constexpr const char* kCutShort = "the file is cut short: it does not end with a footer";

/// Everything else than these is passed over without being read.
bool isRead(McapRecord kind) {
  return kind == McapRecord::kSchema || kind == McapRecord::kChannel || kind == McapRecord::kMessage;
}

}  // namespace

McapReader::McapReader(std::filesystem::path path) : path_(std::move(path)) {
  requireFile(path_);
  file_.open(path_, std::ios::binary);
  size_ = std::filesystem::file_size(path_);
  std::array<uint8_t, kMcapMagic.size()> magic{};
  file_.read(reinterpret_cast<char*>(magic.data()), magic.size());
  if (!file_ || magic != kMcapMagic)
    throw InputError(path_, "is no MCAP file: it does not start with its magic bytes");
}

void McapReader::reset() {
  damage_.clear();
  schemas_.clear();
  channels_.clear();
  chunk_.reset();
  is_in_damaged_chunk_ = false;
}

void McapReader::read(const OnMessage& on_message) {
  reset();
  McapFile bytes(file_, size_);
  readRecords(bytes, kMcapMagic.size(), on_message);
}

void McapReader::note(uint64_t place, const std::string& what) {
  if (damage_.empty())
    damage_ = path_.string() + ": byte " + std::to_string(chunk_.value_or(place)) + ": " + what;
}

McapReader::Next McapReader::readRecords(McapBytes& bytes, uint64_t place, const OnMessage& on_message) {
  Next next = Next::kGoOn;
  while (next == Next::kGoOn && !(chunk_ && place == bytes.size())) {
    try {
      const auto head = mcapHeadAt(bytes, place);
      if (!head) throw McapDamage(chunk_ ? "a chunk ends within a record" : kCutShort);
      if (head->operation == 0) throw McapDamage("no record has the operation code 0");
      if (head->length > bytes.size() - place - kMcapRecordHead)
        throw McapDamage(chunk_ ? "a chunk ends within a record" : "the file is cut short within a record");
      const bool is_end = head->kind() == McapRecord::kFooter || head->kind() == McapRecord::kDataEnd;
      if (is_end && !chunk_ && isMcapRecordAt(bytes, place)) break;
      next = readRecord(bytes, place, *head, on_message);
      place += kMcapRecordHead + head->length;
    } catch (const McapDamage& damage) {
      note(place, damage.what());
      place = passOver(bytes, place, on_message, next);
      if (place == bytes.size()) break;
    }
  }
  return next;
}

McapReader::Next McapReader::readRecord(McapBytes& bytes, uint64_t place, const McapHead& head,
                                        const OnMessage& on_message) {
  const uint64_t content = place + kMcapRecordHead;
  const bool is_chunk = head.kind() == McapRecord::kChunk;
  if (!chunk_ && (is_chunk || isWholeMcapChunk(bytes, content, head.length))) {
    if (!is_chunk) note(place, "a chunk has the operation code " + std::to_string(head.operation));
    const auto chunk = mcapChunkAt(bytes, content);
    if (!chunk || chunk->head + chunk->compressed_size != head.length)
      throw McapDamage("a chunk is of another length than its fields");
    return readChunk(bytes, place, *chunk, on_message);
  }
  if (!isRead(head.kind())) return Next::kGoOn;
  if (head.length > kLargestMcapRecord)
    throw McapDamage("a record has " + std::to_string(head.length) + " bytes");
  return takeRecord(head, bytes.at(content, head.length), on_message);
}

uint64_t McapReader::passOver(McapBytes& bytes, uint64_t place, const OnMessage& on_message, Next& next) {
  const uint64_t content = place + kMcapRecordHead;
  const auto head = mcapHeadAt(bytes, place);
  const bool fits = head && head->length <= bytes.size() - content;
  const bool is_chunk = head && !chunk_ && head->kind() == McapRecord::kChunk;
  if (fits && !is_chunk && isMcapRecordAt(bytes, content + head->length)) return content + head->length;
  const auto chunk = is_chunk ? mcapChunkAt(bytes, content) : std::nullopt;
  const bool is_whole = chunk && content + chunk->head <= bytes.size() &&
                        chunk->compressed_size <= bytes.size() - content - chunk->head &&
                        isMcapRecordAt(bytes, content + chunk->head + chunk->compressed_size);
  const uint64_t found =
      is_whole ? content + chunk->head + chunk->compressed_size : nextMcapRecord(bytes, place + 1);
  // Of one that is cut, what is there; where it is not compressed its records have been found.
  if (is_whole || (chunk && found == bytes.size())) next = readChunk(bytes, place, *chunk, on_message);
  return found;
}

McapReader::Next McapReader::readChunk(McapBytes& bytes, uint64_t place, const McapChunk& chunk,
                                       const OnMessage& on_message) {
  if (chunk.size > kLargestChunk || chunk.compressed_size > kLargestMcapRecord) {
    note(place, "a chunk has " + std::to_string(std::max(chunk.size, chunk.compressed_size)) + " bytes");
    return Next::kGoOn;
  }
  const ByteView compressed = bytes.at(place + kMcapRecordHead + chunk.head, chunk.compressed_size);
  const Decompressed plain = decompress(chunk.compression, compressed, static_cast<size_t>(chunk.size));
  const ByteView records{plain.bytes.data(), plain.bytes.size()};
  const bool is_crc_wrong = chunk.crc != 0 && crc32_z(0, records.data, records.size) != chunk.crc;
  if (!plain.fault.empty()) {
    note(place, "a chunk cannot be decompressed: " + plain.fault);
  } else if (is_crc_wrong) {
    note(place, "a chunk's CRC is wrong");
  }
  chunk_ = place;
  is_in_damaged_chunk_ = is_crc_wrong || !plain.fault.empty();
  McapMemory memory(records);
  const Next next = readRecords(memory, 0, on_message);
  is_in_damaged_chunk_ = false;
  chunk_.reset();
  return next;
}

McapReader::Next McapReader::takeRecord(const McapHead& head, ByteView content, const OnMessage& on_message) {
  if (head.kind() == McapRecord::kMessage) return takeMessage(content, on_message);
  if (head.kind() == McapRecord::kSchema) takeSchema(content);
  if (head.kind() == McapRecord::kChannel) takeChannel(content);
  return Next::kGoOn;
}

void McapReader::takeSchema(ByteView content) {
  McapFields fields(content);
  const auto id = fields.number<uint16_t>();
  if (id == 0) throw McapDamage("a schema has the number 0");
  McapSchema schema;
  schema.name = fields.string();
  schema.encoding = fields.string();
  if (!is_in_damaged_chunk_ || schemas_.count(id) == 0) schemas_[id] = std::move(schema);
}

void McapReader::takeChannel(ByteView content) {
  McapFields fields(content);
  const auto id = fields.number<uint16_t>();
  const auto schema = fields.number<uint16_t>();
  const auto known = channels_.find(id);
  // Repeated in every chunk; the first that is sound counts.
  if (known != channels_.end() && (is_in_damaged_chunk_ || !known->second.is_damaged)) return;
  McapChannel channel;
  channel.topic = fields.string();
  channel.message_encoding = fields.string();
  if (schema != 0) {
    const auto found = schemas_.find(schema);
    if (found == schemas_.end())
      throw McapDamage("channel " + channel.topic + " has a schema that is not there");
    channel.schema = found->second;
  }
  channels_[id] = {std::move(channel), is_in_damaged_chunk_};
}

McapReader::Next McapReader::takeMessage(ByteView content, const OnMessage& on_message) const {
  McapFields fields(content);
  const auto known = channels_.find(fields.number<uint16_t>());
  if (known == channels_.end()) throw McapDamage("a message is of a channel that is not there");
  fields.number<uint32_t>();  // sequence
  const auto log_ns = fields.number<uint64_t>();
  fields.number<uint64_t>();  // publish time
  const bool goes_on = on_message({&known->second.channel, static_cast<int64_t>(log_ns), fields.rest()});
  return goes_on ? Next::kGoOn : Next::kStop;
}

std::optional<ByteView> McapReader::summaryPart(McapBytes& bytes) const {
  constexpr uint64_t kFooterLength = 20, kFooter = kMcapRecordHead + kFooterLength, kCrc = 4;
  if (size_ < kFooter + 2 * kMcapMagic.size()) return std::nullopt;
  const uint64_t footer = size_ - kMcapMagic.size() - kFooter;
  const auto head = mcapHeadAt(bytes, footer);
  if (!head || head->kind() != McapRecord::kFooter || head->length != kFooterLength) return std::nullopt;
  McapFields fields(bytes.at(footer + kMcapRecordHead, kFooterLength));
  const auto start = fields.number<uint64_t>();
  fields.number<uint64_t>();  // of the offsets
  const auto crc = fields.number<uint32_t>();
  if (start == 0 || start >= footer || footer - start > kLargestMcapRecord) return std::nullopt;
  const ByteView part = bytes.at(start, footer + kFooter - kCrc - start);
  if (crc != 0 && crc32_z(0, part.data, part.size) != crc) return std::nullopt;
  return ByteView{part.data, static_cast<size_t>(footer - start)};
}

void McapReader::takeStatistics(ByteView content, McapCounts& counts) const {
  constexpr uint64_t kTotals = 8 + 2 + 4 + 4 + 4 + 4 + 8 + 8;
  McapFields fields(content);
  fields.take(kTotals);
  McapFields by_channel(fields.take(fields.number<uint32_t>()));
  while (!by_channel.atEnd()) {
    const auto channel = channels_.find(by_channel.number<uint16_t>());
    const auto messages = static_cast<int64_t>(by_channel.number<uint64_t>());
    if (channel == channels_.end()) throw McapDamage("statistics of a channel that is not there");
    if (messages > 0) counts.emplace_back(channel->second.channel, messages);
  }
}

std::optional<McapCounts> McapReader::summary() {
  reset();
  McapFile bytes(file_, size_);
  const auto part = summaryPart(bytes);
  if (!part) return std::nullopt;
  McapCounts counts;
  bool has_statistics = false;
  try {
    for (McapFields records(*part); !records.atEnd();) {
      McapHead head;
      head.operation = records.number<uint8_t>();
      head.length = records.number<uint64_t>();
      const ByteView content = records.take(head.length);
      if (head.kind() == McapRecord::kSchema) takeSchema(content);
      if (head.kind() == McapRecord::kChannel) takeChannel(content);
      if (head.kind() != McapRecord::kStatistics) continue;
      has_statistics = true;
      takeStatistics(content, counts);
    }
  } catch (const McapDamage&) {
    return std::nullopt;
  }
  if (!has_statistics) return std::nullopt;
  return counts;
}

}  // namespace redbee
