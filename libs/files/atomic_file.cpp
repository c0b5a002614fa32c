#include "redbee/files/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include "redbee/files/input_error.hpp"

namespace redbee {

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  if (std::filesystem::is_directory(path_)) throw InputError(path_, "cannot be written: it is a folder");
  file_ = std::fopen(partial_.c_str(), "wb");
  if (file_ == nullptr) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void AtomicFile::write(const void* data, size_t size) {
  if (std::fwrite(data, 1, size, file_) != size) fail(errno);
}

void AtomicFile::close() {
  if (file_ == nullptr) return;
  if (std::fflush(file_) != 0) fail(errno);
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(partial_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
    fail(error);
  }
}

void AtomicFile::fail(int error) const {
  throw InputError(path_, std::string("cannot be written: ") + std::strerror(error));
}

void writeAtomically(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.close();
}

}  // namespace redbee
