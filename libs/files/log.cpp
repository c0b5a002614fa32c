#include "redbee/files/log.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

constexpr uint32_t kSync = 0xEDA1DA01;
constexpr int64_t kHeaderSize = 28;
constexpr int32_t kMaxChannelSize = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH

template <typename Integer>
void putBigEndian(std::string& out, Integer value) {
  for (int shift = static_cast<int>(sizeof(Integer)) * 8 - 8; shift >= 0; shift -= 8) {
    out.push_back(static_cast<char>(static_cast<uint64_t>(value) >> shift));
  }
}

std::vector<uint8_t> syncWord() {
  std::string word;
  putBigEndian<uint32_t>(word, kSync);
  return {word.begin(), word.end()};
}

template <typename Integer>
Integer getBigEndian(const uint8_t* from) {
  uint64_t value = 0;
  for (size_t i = 0; i < sizeof(Integer); ++i) value = value << 8 | from[i];
  return static_cast<Integer>(value);
}

/// Throws InputError where only F.lcm.0000 and so on are there of F.lcm.
void requireNotInParts(const std::filesystem::path& log) {
  std::error_code error;
  if (std::filesystem::exists(log, error)) return;
  const std::filesystem::path folder = log.has_parent_path() ? log.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string end = entry.path().extension().string();
    if (entry.path().stem() != log.filename() || end.size() < 2) continue;
    if (end.find_first_not_of("0123456789", 1) != std::string::npos) continue;
    std::string fault = "no such file, but its parts: redbee log repair ";
    fault += log.string();
    fault += ".* --out ";
    fault += log.string();
    throw InputError(log, fault);
  }
}

}  // namespace

std::string eventHeader(int64_t number, int64_t utime, const std::string& channel, size_t data_size) {
  std::string header;
  putBigEndian<uint32_t>(header, kSync);
  putBigEndian<int64_t>(header, number);
  putBigEndian<int64_t>(header, utime);
  putBigEndian<int32_t>(header, static_cast<int32_t>(channel.size()));
  putBigEndian<int32_t>(header, static_cast<int32_t>(data_size));
  return header + channel;
}

void LogWriter::write(int64_t utime, const std::string& channel, const std::vector<uint8_t>& data) {
  if (channel.empty() || channel.size() > static_cast<size_t>(kMaxChannelSize)) {
    throw InputError(file_.path(), "channel name '" + channel + "' must have 1 to 63 characters");
  }
  const std::string header = eventHeader(number_++, utime, channel, data.size());
  file_.write(header);
  file_.write(data.data(), data.size());
  bytes_ += static_cast<int64_t>(header.size() + data.size());
}

LogReader::LogReader(std::filesystem::path path) : path_(std::move(path)) {
  requireNotInParts(path_);
  requireFile(path_);
  file_.open(path_, std::ios::binary);
  if (!file_) throw InputError(path_, std::string("cannot be opened: ") + std::strerror(errno));
  size_ = static_cast<int64_t>(std::filesystem::file_size(path_));
  if (size_ == 0) throw InputError(path_, "is empty");
  if (!headerAt(0) && !resynchronise(0)) throw InputError(path_, "holds no LCM event (byte 0 on)");
}

void LogReader::rewind() {
  position_ = 0;
  damaged_ = 0;
  truncated_ = false;
  damage_report_.clear();
}

std::optional<LogEvent> LogReader::next() {
  while (position_ < size_) {
    const auto header = headerAt(position_);
    if (header && hasConsistentLength(*header)) {
      if (auto event = readEvent(*header)) return event;
    }
    skipDamage();
  }
  return std::nullopt;
}

bool LogReader::hasConsistentLength(const Header& header) {
  const int64_t end = position_ + header.size();
  if (eventFollows(end)) return true;
  const auto later = resynchronise(position_ + 1);
  if (!later) return true;  // no further event follows
  if (*later < end) return false;
  // Either this event's length is wrong or the next one's start is damaged. In the second case an event
  // number is missing.
  return headerAt(*later)->number > header.number + 1;
}

std::optional<LogEvent> LogReader::readEvent(const Header& header) {
  LogEvent event;
  event.number = header.number;
  event.utime = header.utime;
  event.channel.resize(static_cast<size_t>(header.channel_size));
  event.data.resize(static_cast<size_t>(header.data_size));
  const int64_t name_at = position_ + kHeaderSize;
  if (!readAt(name_at, event.channel.data(), event.channel.size())) return std::nullopt;
  if (!readAt(name_at + header.channel_size, event.data.data(), event.data.size())) return std::nullopt;
  position_ += header.size();
  return event;
}

void LogReader::skipDamage() {
  const auto resumed = resynchronise(position_ + 1);
  if (resumed) {
    ++damaged_;
    reportDamage(position_, "damaged event, skipped " + std::to_string(*resumed - position_) + " bytes");
    position_ = *resumed;
  } else {
    truncated_ = true;
    reportDamage(position_, "the last event is cut short or damaged");
    position_ = size_;
  }
}

int64_t LogReader::Header::size() const { return kHeaderSize + channel_size + data_size; }

std::optional<LogReader::Header> LogReader::headerAt(int64_t offset) {
  std::array<uint8_t, kHeaderSize> bytes{};
  if (offset + kHeaderSize > size_ || !readAt(offset, bytes.data(), bytes.size())) return std::nullopt;
  if (getBigEndian<uint32_t>(bytes.data()) != kSync) return std::nullopt;
  Header header;
  header.number = getBigEndian<int64_t>(bytes.data() + 4);
  header.utime = getBigEndian<int64_t>(bytes.data() + 12);
  header.channel_size = getBigEndian<int32_t>(bytes.data() + 20);
  header.data_size = getBigEndian<int32_t>(bytes.data() + 24);
  const bool plausible = header.channel_size > 0 && header.channel_size <= kMaxChannelSize &&
                         header.data_size >= 0 && offset + header.size() <= size_;
  return plausible ? std::optional<Header>(header) : std::nullopt;
}

bool LogReader::eventFollows(int64_t offset) {
  if (offset == size_) return true;
  std::array<uint8_t, 4> bytes{};
  // Fewer bytes than a sync word are the rest of a truncated event; what precedes them is complete.
  const size_t there = static_cast<size_t>(std::min<int64_t>(4, size_ - offset));
  if (!readAt(offset, bytes.data(), there)) return false;
  const std::vector<uint8_t> sync = syncWord();
  return std::equal(bytes.begin(), bytes.begin() + static_cast<long>(there), sync.begin());
}

std::optional<int64_t> LogReader::resynchronise(int64_t from) {
  const std::vector<uint8_t> sync = syncWord();
  std::vector<uint8_t> block(64 * 1024);
  for (int64_t at = from; at + kHeaderSize <= size_;) {
    const size_t count =
        static_cast<size_t>(std::min<int64_t>(static_cast<int64_t>(block.size()), size_ - at));
    if (!readAt(at, block.data(), count)) return std::nullopt;
    const auto end = block.begin() + static_cast<long>(count);
    for (auto it = block.begin(); (it = std::search(it, end, sync.begin(), sync.end())) != end; ++it) {
      const int64_t candidate = at + (it - block.begin());
      const auto header = headerAt(candidate);
      if (header && eventFollows(candidate + header->size())) return candidate;
    }
    at += static_cast<int64_t>(count) - 3;  // a sync word may span two blocks
    if (count < block.size()) break;
  }
  return std::nullopt;
}

void LogReader::reportDamage(int64_t offset, const std::string& what) {
  if (damage_report_.empty())
    damage_report_ = path_.string() + ": byte " + std::to_string(offset) + ": " + what;
}

bool LogReader::readAt(int64_t offset, void* into, size_t count) {
  if (count == 0) return true;
  file_.clear();
  if (file_.tellg() != offset) file_.seekg(offset);
  file_.read(static_cast<char*>(into), static_cast<std::streamsize>(count));
  return static_cast<size_t>(file_.gcount()) == count;
}

}  // namespace redbee
