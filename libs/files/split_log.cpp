#include "redbee/files/split_log.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "redbee/files/input_error.hpp"

namespace redbee {

SplitLog::SplitLog(std::filesystem::path prefix, int64_t split_bytes)
    : prefix_(std::move(prefix)), split_bytes_(split_bytes) {
  openNext();
}

void SplitLog::write(const ReceivedMessage& message) {
  if (bytes_ > split_bytes_) {
    sync();
    openNext();
  }
  lcm::LogEvent event{};
  event.timestamp = message.utime;
  event.channel = message.channel;
  event.datalen = static_cast<int32_t>(message.data.size());
  // LCM's event takes non-const pointers to what it only reads.
  event.data = const_cast<uint8_t*>(message.data.data());
  if (log_->writeEvent(&event) != 0) fail();
  bytes_ += message.bytes();
}

void SplitLog::sync() {
  std::FILE* file = log_->getFilePtr();
  if (std::fflush(file) != 0 || fdatasync(fileno(file)) != 0) fail();
}

void SplitLog::openNext() {
  do {
    file_ = prefix_;
    file_ += fmt::format(".{:02}", number_++);
  } while (std::filesystem::exists(file_));
  log_ = std::make_unique<lcm::LogFile>(file_.string(), "w");
  if (!log_->good()) fail();
  bytes_ = 0;
}

void SplitLog::fail() const {
  throw InputError(file_, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace redbee
