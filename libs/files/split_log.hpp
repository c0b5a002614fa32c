// A log split into files while it is recorded: LCM logs NAME.00, NAME.01, ..., each readable by itself;
// concatenated in order they are one log.
#pragma once

#include <cstdint>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <vector>

namespace redbee {

/// A message as received.
struct ReceivedMessage {
  int64_t utime = 0;  ///< us, of its arrival
  std::string channel;
  std::vector<uint8_t> data;

  int64_t bytes() const { return static_cast<int64_t>(sizeof *this + channel.size() + data.size()); }
};

/// Unlike with LogWriter, whatever is written remains on disk even if the process is killed. Existing files
/// are never overwritten; numbering continues after them. Throws InputError on a write error.
class SplitLog {
 public:
  /// A new file is started after the message with which the current one exceeds `split_bytes`.
  SplitLog(std::filesystem::path prefix, int64_t split_bytes);

  void write(const ReceivedMessage& message);
  /// Flushes all data to disk (fsync).
  void sync();
  const std::filesystem::path& file() const { return file_; }

 private:
  void openNext();
  [[noreturn]] void fail() const;

  std::filesystem::path prefix_;
  int64_t split_bytes_;
  int number_ = 0;
  int64_t bytes_ = 0;
  std::filesystem::path file_;
  std::unique_ptr<lcm::LogFile> log_;
};

}  // namespace redbee
