#include "redbee/files/mcap_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "redbee/files/decompress.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr uint64_t kRecordHead = 9;              ///< bytes: operation code and length
constexpr uint64_t kLargestRecord = 1ULL << 30;  ///< bytes; recorders make chunks of some megabytes
constexpr uint64_t kLargestChunk = 512ULL << 20;

/// Damage; what() is part of a line.
class McapDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The fields of a record.
class Fields {
 public:
  explicit Fields(ByteView bytes) : bytes_(bytes) {}

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
  ByteView take(uint64_t count) {
    if (count > bytes_.size) throw McapDamage("a record is shorter than its fields");
    const ByteView taken{bytes_.data, static_cast<size_t>(count)};
    bytes_ = {bytes_.data + count, bytes_.size - static_cast<size_t>(count)};
    return taken;
  }
  ByteView rest() const { return bytes_; }
  bool atEnd() const { return bytes_.size == 0; }

 private:
  ByteView bytes_;
};

McapRecord kindOf(uint8_t operation) { return static_cast<McapRecord>(operation); }

/// Everything else than these is passed over without being read.
bool isRead(uint8_t operation) {
  const McapRecord kind = kindOf(operation);
  return kind == McapRecord::kSchema || kind == McapRecord::kChannel || kind == McapRecord::kMessage ||
         kind == McapRecord::kChunk;
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

void McapReader::read(const OnMessage& on_message) {
  damage_.clear();
  schemas_.clear();
  channels_.clear();
  file_.clear();
  position_ = kMcapMagic.size();
  try {
    while (readRecord(on_message) == Next::kGoOn) {
    }
  } catch (const McapDamage& damage) {
    damage_ = path_.string() + ": byte " + std::to_string(position_) + ": " + damage.what();
  }
}

McapReader::Next McapReader::readRecord(const OnMessage& on_message) {
  std::array<uint8_t, kRecordHead> head{};
  if (position_ + kRecordHead > size_)
    throw McapDamage("the file is cut short: it does not end with a footer");
  file_.seekg(static_cast<std::streamoff>(position_));
  file_.read(reinterpret_cast<char*>(head.data()), head.size());
  Fields fields({head.data(), head.size()});
  const auto operation = fields.number<uint8_t>();
  const auto length = fields.number<uint64_t>();
  if (length > size_ - position_ - kRecordHead) throw McapDamage("the file is cut short within a record");
  if (operation == 0) throw McapDamage("no record has the operation code 0");
  if (kindOf(operation) == McapRecord::kFooter || kindOf(operation) == McapRecord::kDataEnd)
    return Next::kStop;
  Next next = Next::kGoOn;
  if (isRead(operation)) {
    if (length > kLargestRecord) throw McapDamage("a record has " + std::to_string(length) + " bytes");
    std::vector<uint8_t> content(static_cast<size_t>(length));
    file_.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(content.size()));
    if (!file_) throw McapDamage("cannot be read");
    next = kindOf(operation) == McapRecord::kChunk
               ? readChunk(content, on_message)
               : takeRecord(operation, {content.data(), content.size()}, on_message);
  }
  position_ += kRecordHead + length;
  return next;
}

McapReader::Next McapReader::readChunk(const std::vector<uint8_t>& content, const OnMessage& on_message) {
  Fields fields({content.data(), content.size()});
  fields.number<uint64_t>();  // first and last time
  fields.number<uint64_t>();
  const auto size = fields.number<uint64_t>();
  const auto crc = fields.number<uint32_t>();
  const std::string method = fields.string();
  const ByteView compressed = fields.take(fields.number<uint64_t>());
  if (size > kLargestChunk) throw McapDamage("a chunk has " + std::to_string(size) + " bytes");
  std::vector<uint8_t> plain;
  try {
    plain = decompress(method, compressed, static_cast<size_t>(size));
  } catch (const std::runtime_error& error) {
    throw McapDamage(std::string("a chunk cannot be decompressed: ") + error.what());
  }
  if (crc != 0 && crc32_z(0, plain.data(), plain.size()) != crc) throw McapDamage("a chunk's CRC is wrong");
  Fields records({plain.data(), plain.size()});
  while (!records.atEnd()) {
    const auto operation = records.number<uint8_t>();
    const ByteView record = records.take(records.number<uint64_t>());
    if (takeRecord(operation, record, on_message) == Next::kStop) return Next::kStop;
  }
  return Next::kGoOn;
}

McapReader::Next McapReader::takeRecord(uint8_t operation, ByteView content, const OnMessage& on_message) {
  switch (kindOf(operation)) {
    case McapRecord::kSchema:
      takeSchema(content);
      return Next::kGoOn;
    case McapRecord::kChannel:
      takeChannel(content);
      return Next::kGoOn;
    case McapRecord::kMessage:
      return takeMessage(content, on_message);
    default:
      return Next::kGoOn;  // the specification lets readers pass over what they do not know
  }
}

void McapReader::takeSchema(ByteView content) {
  Fields fields(content);
  const auto id = fields.number<uint16_t>();
  if (id == 0) throw McapDamage("a schema has the number 0");
  McapSchema schema;
  schema.name = fields.string();
  schema.encoding = fields.string();
  schemas_[id] = std::move(schema);
}

void McapReader::takeChannel(ByteView content) {
  Fields fields(content);
  const auto id = fields.number<uint16_t>();
  const auto schema = fields.number<uint16_t>();
  if (channels_.count(id) > 0) return;  // repeated in every chunk; pointers to the first stay good
  McapChannel channel;
  channel.topic = fields.string();
  channel.message_encoding = fields.string();
  if (schema != 0) {
    const auto found = schemas_.find(schema);
    if (found == schemas_.end())
      throw McapDamage("channel " + channel.topic + " has a schema that is not there");
    channel.schema = found->second;
  }
  channels_[id] = std::move(channel);
}

McapReader::Next McapReader::takeMessage(ByteView content, const OnMessage& on_message) const {
  Fields fields(content);
  const auto channel = channels_.find(fields.number<uint16_t>());
  if (channel == channels_.end()) throw McapDamage("a message is of a channel that is not there");
  fields.number<uint32_t>();  // sequence
  const auto log_ns = fields.number<uint64_t>();
  fields.number<uint64_t>();  // publish time
  const bool goes_on = on_message({&channel->second, static_cast<int64_t>(log_ns), fields.rest()});
  return goes_on ? Next::kGoOn : Next::kStop;
}

}  // namespace redbee
