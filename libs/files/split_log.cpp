#include "redbee/files/split_log.hpp"

#include <spdlog/fmt/fmt.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"

namespace redbee {

int64_t freeBytes(int file) {
  struct statvfs disk {};
  if (fstatvfs(file, &disk) != 0) return -1;
  return static_cast<int64_t>(disk.f_bavail) * static_cast<int64_t>(disk.f_frsize);
}

SplitLog::SplitLog(std::filesystem::path prefix, int64_t split_bytes, int64_t min_free_bytes,
                   std::function<int64_t(int)> free_bytes)
    : prefix_(std::move(prefix)),
      split_bytes_(split_bytes),
      min_free_bytes_(min_free_bytes),
      free_bytes_(std::move(free_bytes)) {
  openNext();
}

void SplitLog::write(const ReceivedMessage& message) {
  if (bytes_ > split_bytes_) {
    sync();
    openNext();
  }
  std::string event = eventHeader(event_number_, message.utime, message.channel, message.data.size());
  event.append(reinterpret_cast<const char*>(message.data.data()), message.data.size());
  const auto size = static_cast<int64_t>(event.size());
  requireRoomFor(size);
  if (!file_.write(event)) {
    const int error = errno;
    // What cannot be shortened either is found by whoever reads it.
    static_cast<void>(ftruncate(file_.get(), bytes_) == 0);
    errno = error;
    fail();
  }
  ++event_number_;
  bytes_ += size;
}

void SplitLog::requireRoomFor(int64_t bytes) const {
  if (min_free_bytes_ <= 0) return;
  const int64_t free = free_bytes_(file_.get());
  if (free < 0) fail();
  // An event ends within a block of the disk, and the name of the file and the tables of the disk take some,
  // too.
  constexpr int64_t kMargin = 64 << 10;
  if (free - bytes - kMargin >= min_free_bytes_) return;
  throw InputError(path_,
                   fmt::format("{:.0f} MB free, {:.0f} MB are kept free", static_cast<double>(free) / 1e6,
                               static_cast<double>(min_free_bytes_) / 1e6));
}

void SplitLog::sync() {
  if (fdatasync(file_.get()) != 0) fail();
}

void SplitLog::openNext() {
  do {
    path_ = prefix_;
    path_ += fmt::format(".{:04}", file_number_++);
    file_ = createFile(path_);
  } while (!file_.isOpen() && errno == EEXIST);
  if (!file_.isOpen()) fail();
  event_number_ = 0;
  bytes_ = 0;
}

void SplitLog::fail() const {
  throw InputError(path_, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace redbee
