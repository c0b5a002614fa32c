// Recorded flights in LCM's log format, compatible with lcm-logplayer and lcm-logger.
//
// An event, all numbers big-endian: uint32 0xEDA1DA01, int64 event number, int64 timestamp [us], int32 length
// of the channel's name, int32 length of the data, name, data. The timestamp of events written here is the
// time inside the message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "redbee/files/atomic_file.hpp"

namespace redbee {

/// An event of the log; `utime` is the time inside the message.
struct LogEvent {
  int64_t number = 0;
  int64_t utime = 0;  ///< us
  std::string channel;
  std::vector<uint8_t> data;
};

/// What stands before the data of an event.
std::string eventHeader(int64_t number, int64_t utime, const std::string& channel, size_t data_size);

/// The log appears under its name on close(); without close() no file remains. Throws InputError if it cannot
/// be written.
class LogWriter {
 public:
  explicit LogWriter(const std::filesystem::path& path) : file_(path) {}

  void write(int64_t utime, const std::string& channel, const std::vector<uint8_t>& data);
  /// Any lcm-gen message with a utime.
  template <typename Message>
  void write(const std::string& channel, const Message& message) {
    std::vector<uint8_t> data(static_cast<size_t>(message.getEncodedSize()));
    message.encode(data.data(), 0, static_cast<int>(data.size()));
    write(message.utime, channel, data);
  }
  void close() { file_.close(); }
  int64_t events() const { return number_; }
  int64_t bytes() const { return bytes_; }

 private:
  AtomicFile file_;
  int64_t number_ = 0;
  int64_t bytes_ = 0;
};

/// Reads events in file order. A damaged event is skipped: the reader searches for the next position where a
/// plausible event starts that is followed by another one or by the end of the file. Lengths are compared
/// with the size of the file before anything is allocated.
class LogReader {
 public:
  /// Throws InputError if the file cannot be read or is not an LCM log.
  explicit LogReader(std::filesystem::path path);

  /// The next complete event; std::nullopt at the end.
  std::optional<LogEvent> next();
  /// Back to the first event; the counts are reset.
  void rewind();

  int64_t size() const { return size_; }          ///< bytes
  int64_t position() const { return position_; }  ///< bytes read so far, for progress
  int64_t damaged() const { return damaged_; }    ///< damaged sections that were skipped
  bool truncated() const { return truncated_; }   ///< the last event is incomplete
  /// One line with file and byte offset of the first damage; empty if there was none.
  const std::string& damageReport() const { return damage_report_; }

 private:
  struct Header {
    int64_t number = 0;
    int64_t utime = 0;
    int32_t channel_size = 0;
    int32_t data_size = 0;
    int64_t size() const;  ///< bytes, of the whole event
  };
  std::optional<Header> headerAt(int64_t offset);
  bool eventFollows(int64_t offset);
  bool hasConsistentLength(const Header& header);
  std::optional<LogEvent> readEvent(const Header& header);
  void skipDamage();
  std::optional<int64_t> resynchronise(int64_t from);
  void reportDamage(int64_t offset, const std::string& what);
  bool readAt(int64_t offset, void* into, size_t count);

  std::filesystem::path path_;
  std::ifstream file_;
  int64_t size_ = 0;
  int64_t position_ = 0;
  int64_t damaged_ = 0;
  bool truncated_ = false;
  std::string damage_report_;
};

}  // namespace redbee
