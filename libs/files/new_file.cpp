#include "redbee/files/new_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "redbee/files/input_file.hpp"

namespace redbee {

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

bool FileDescriptor::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

bool FileDescriptor::close() { return ::close(std::exchange(fd_, -1)) == 0; }

FileDescriptor createFile(const std::filesystem::path& path) {
  constexpr mode_t kMode = 0666;  // less the umask
  return FileDescriptor(open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode));
}

PartialFile::PartialFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  if (std::filesystem::exists(path_)) {
    const std::string fault = faultOfFile(path_);
    if (!fault.empty()) throw InputError(path_, "cannot be written: it " + fault);
  }
  unlink(partial_.c_str());
  file_ = createFile(partial_);
  if (!file_.isOpen()) fail(errno);
}

PartialFile::~PartialFile() {
  if (file_.isOpen()) unlink(partial_.c_str());
}

std::filesystem::path PartialFile::descriptorPath() const {
  return "/proc/self/fd/" + std::to_string(file_.get());
}

void PartialFile::write(std::string_view bytes) {
  if (!file_.write(bytes)) fail(errno);
}

void PartialFile::commit() {
  if (!file_.isOpen()) return;
  if (!file_.close() || std::rename(partial_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    unlink(partial_.c_str());
    fail(error);
  }
}

void PartialFile::fail(int error) const {
  throw InputError(path_, std::string("cannot be written: ") + std::strerror(error));
}

}  // namespace redbee
