// A log split into files while it is recorded: LCM logs NAME.0000, NAME.0001, ..., each readable by itself;
// concatenated in order they are one log. Four digits, so that a shell lists them in order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "redbee/files/new_file.hpp"

namespace redbee {

/// A message as received.
struct ReceivedMessage {
  int64_t utime = 0;  ///< us, of its arrival
  std::string channel;
  std::vector<uint8_t> data;

  int64_t bytes() const { return static_cast<int64_t>(sizeof *this + channel.size() + data.size()); }
};

/// Bytes that remain for unprivileged users on the disk of an open file. -1, and errno, if it does not tell.
int64_t freeBytes(int file);

/// Unlike with LogWriter, whatever is written remains on disk even if the process is killed. Existing files
/// are never overwritten; numbering continues after them. Throws InputError on a write error; what the file
/// then holds of the last event is removed, so that it ends with a whole one.
class SplitLog {
 public:
  /// A new file is started after the message with which the current one exceeds `split_bytes`. At least
  /// `min_free_bytes` of the disk stay free: a message that would take more throws InputError and is not
  /// written. `free_bytes` tells what is free on the disk of the file that is given to it.
  SplitLog(std::filesystem::path prefix, int64_t split_bytes, int64_t min_free_bytes = 0,
           std::function<int64_t(int)> free_bytes = freeBytes);

  void write(const ReceivedMessage& message);
  /// Flushes all data to disk (fsync).
  void sync();
  const std::filesystem::path& file() const { return path_; }

 private:
  void openNext();
  void requireRoomFor(int64_t bytes) const;
  [[noreturn]] void fail() const;

  std::filesystem::path prefix_;
  int64_t split_bytes_;
  int64_t min_free_bytes_;
  std::function<int64_t(int)> free_bytes_;
  int file_number_ = 0;
  int64_t event_number_ = 0;
  int64_t bytes_ = 0;  ///< of the current file, whole events
  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace redbee
