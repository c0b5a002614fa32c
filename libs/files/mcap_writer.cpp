#include "redbee/files/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace redbee {
namespace {

constexpr size_t kChunkBytes = 4 << 20;  ///< what other writers take; a message of an image fits
constexpr int kZstdLevel = 1;            ///< JPEGs gain nothing by a higher one

template <typename Unsigned>
std::string littleEndian(Unsigned value) {
  std::string bytes;
  for (size_t i = 0; i < sizeof(Unsigned); ++i)
    bytes += static_cast<char>(static_cast<uint64_t>(value) >> (8 * i) & 0xFF);
  return bytes;
}

std::string counted(const std::string& bytes) {
  return littleEndian(static_cast<uint32_t>(bytes.size())) + bytes;
}

std::string recordOf(McapRecord kind, const std::string& content) {
  return littleEndian(static_cast<uint8_t>(kind)) + littleEndian(static_cast<uint64_t>(content.size())) +
         content;
}

uint32_t crcOf(uint32_t before, const std::string& bytes) {
  return static_cast<uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string compressed(const std::string& plain) {
  std::string out(ZSTD_compressBound(plain.size()), '\0');
  const size_t size = ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), kZstdLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, const std::string& profile,
                       const std::string& library)
    : file_(path) {
  append({kMcapMagic.begin(), kMcapMagic.end()});
  appendRecord(McapRecord::kHeader, counted(profile) + counted(library));
}

uint16_t McapWriter::addChannel(const std::string& topic, const McapSchema& schema,
                                const std::string& message_encoding) {
  const std::string text = counted(schema.name) + counted(schema.encoding) + counted(schema.text);
  auto found = std::find(schemas_.begin(), schemas_.end(), text);
  if (found == schemas_.end()) {
    found = schemas_.insert(found, text);
    schema_is_in_file_.push_back(false);
  }
  Channel channel;
  channel.schema = static_cast<uint16_t>(found - schemas_.begin() + 1);
  const auto number = static_cast<uint16_t>(channels_.size() + 1);
  channel.record =
      recordOf(McapRecord::kChannel, littleEndian(number) + littleEndian(channel.schema) + counted(topic) +
                                         counted(message_encoding) + counted(""));
  channels_.push_back(channel);
  return number;
}

void McapWriter::write(uint16_t number, int64_t log_ns, const std::vector<uint8_t>& message) {
  if (log_ns < 0) throw std::invalid_argument("a time of MCAP is not negative");
  Channel& channel = channels_.at(number - 1U);
  writeChannelOnce(channel);
  const auto time = static_cast<uint64_t>(log_ns);
  const bool is_first =
      std::all_of(channels_.begin(), channels_.end(), [](const Channel& c) { return c.index.empty(); });
  chunk_first_ns_ = is_first ? time : std::min(chunk_first_ns_, time);
  chunk_last_ns_ = is_first ? time : std::max(chunk_last_ns_, time);
  channel.index += littleEndian(time) + littleEndian(static_cast<uint64_t>(chunk_.size()));
  const std::string head =
      littleEndian(number) + littleEndian(channel.sequence++) + littleEndian(time) + littleEndian(time);
  ++channel.messages;
  chunk_ += littleEndian(static_cast<uint8_t>(McapRecord::kMessage)) +
            littleEndian(static_cast<uint64_t>(head.size() + message.size())) + head;
  chunk_.append(reinterpret_cast<const char*>(message.data()), message.size());
  if (chunk_.size() >= kChunkBytes) closeChunk();
}

void McapWriter::writeChannelOnce(Channel& channel) {
  if (channel.is_in_file) return;
  const size_t schema = channel.schema - 1U;
  if (!schema_is_in_file_[schema]) {
    chunk_ += recordOf(McapRecord::kSchema, littleEndian(channel.schema) + schemas_[schema]);
    schema_is_in_file_[schema] = true;
  }
  chunk_ += channel.record;
  channel.is_in_file = true;
}

void McapWriter::closeChunk() {
  if (chunk_.empty()) return;
  const std::string records = compressed(chunk_);
  ChunkIndex chunk{chunk_first_ns_, chunk_last_ns_, position_, 0, 0, records.size(), chunk_.size(), {}};
  appendRecord(McapRecord::kChunk, littleEndian(chunk_first_ns_) + littleEndian(chunk_last_ns_) +
                                       littleEndian(chunk.size) + littleEndian(crcOf(0, chunk_)) +
                                       counted("zstd") + littleEndian(chunk.compressed_size) + records);
  chunk.length = position_ - chunk.start;
  const uint64_t index_start = position_;
  for (size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    const auto number = static_cast<uint16_t>(i + 1);
    chunk.index_offsets[number] = position_;
    appendRecord(McapRecord::kMessageIndex, littleEndian(number) + counted(channels_[i].index));
    channels_[i].index.clear();
  }
  chunk.index_length = position_ - index_start;
  chunks_.push_back(chunk);
  chunk_.clear();
}

void McapWriter::close() {
  closeChunk();
  appendRecord(McapRecord::kDataEnd, littleEndian(crc_));
  writeSummary();
  file_.close();
}

void McapWriter::writeSummary() {
  const uint64_t summary_start = position_;
  crc_ = 0;
  std::string offsets;
  const auto group = [&](McapRecord kind, const std::vector<std::string>& records) {
    const uint64_t start = position_;
    for (const std::string& record : records) append(record);
    if (records.empty()) return;
    offsets +=
        recordOf(McapRecord::kSummaryOffset, littleEndian(static_cast<uint8_t>(kind)) + littleEndian(start) +
                                                 littleEndian(position_ - start));
  };
  std::vector<std::string> schemas, channels, chunks;
  for (size_t i = 0; i < schemas_.size(); ++i)
    schemas.push_back(
        recordOf(McapRecord::kSchema, littleEndian(static_cast<uint16_t>(i + 1)) + schemas_[i]));
  for (const Channel& channel : channels_) channels.push_back(channel.record);
  for (const ChunkIndex& chunk : chunks_) {
    std::string index_offsets;
    for (const auto& [channel, offset] : chunk.index_offsets)
      index_offsets += littleEndian(channel) + littleEndian(offset);
    chunks.push_back(
        recordOf(McapRecord::kChunkIndex,
                 littleEndian(chunk.first_ns) + littleEndian(chunk.last_ns) + littleEndian(chunk.start) +
                     littleEndian(chunk.length) + counted(index_offsets) + littleEndian(chunk.index_length) +
                     counted("zstd") + littleEndian(chunk.compressed_size) + littleEndian(chunk.size)));
  }
  group(McapRecord::kSchema, schemas);
  group(McapRecord::kChannel, channels);
  group(McapRecord::kStatistics, {recordOf(McapRecord::kStatistics, statistics())});
  group(McapRecord::kChunkIndex, chunks);
  const uint64_t offsets_start = position_;
  append(offsets);
  // The CRC is of the summary and of the footer up to it.
  const std::string footer =
      recordOf(McapRecord::kFooter,
               littleEndian(summary_start) + littleEndian(offsets_start) + littleEndian(uint32_t{0}));
  append(footer.substr(0, footer.size() - sizeof(uint32_t)));
  append(littleEndian(crc_));
  append({kMcapMagic.begin(), kMcapMagic.end()});
}

std::string McapWriter::statistics() const {
  uint64_t messages = 0, first = 0, last = 0;
  std::string counts;
  for (size_t i = 0; i < channels_.size(); ++i) {
    messages += channels_[i].messages;
    counts += littleEndian(static_cast<uint16_t>(i + 1)) + littleEndian(channels_[i].messages);
  }
  for (const ChunkIndex& chunk : chunks_) {
    first = &chunk == &chunks_.front() ? chunk.first_ns : std::min(first, chunk.first_ns);
    last = std::max(last, chunk.last_ns);
  }
  return littleEndian(messages) + littleEndian(static_cast<uint16_t>(schemas_.size())) +
         littleEndian(static_cast<uint32_t>(channels_.size())) + littleEndian(uint32_t{0}) +
         littleEndian(uint32_t{0}) + littleEndian(static_cast<uint32_t>(chunks_.size())) +
         littleEndian(first) + littleEndian(last) + counted(counts);
}

void McapWriter::append(const std::string& bytes) {
  file_.write(bytes);
  crc_ = crcOf(crc_, bytes);
  position_ += bytes.size();
}

void McapWriter::appendRecord(McapRecord kind, const std::string& content) {
  append(recordOf(kind, content));
}

}  // namespace redbee
