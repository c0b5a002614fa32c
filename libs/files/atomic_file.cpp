#include "redbee/files/atomic_file.hpp"

namespace redbee {
namespace {

constexpr size_t kBufferBytes = size_t{64} << 10;

}  // namespace

void AtomicFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > kBufferBytes) {
    file_.write(buffer_);
    buffer_.clear();
  }
  if (text.size() > kBufferBytes) return file_.write(text);
  buffer_.append(text);
}

void AtomicFile::close() {
  if (!file_.isOpen()) return;
  file_.write(buffer_);
  buffer_.clear();
  file_.commit();
}

void checkWritable(const std::filesystem::path& path) { const PartialFile file(path); }

void checkWritableFolder(const std::filesystem::path& folder) {
  std::filesystem::path there = std::filesystem::absolute(folder);
  if (std::filesystem::exists(there)) return checkWritable(there / "summary.json");
  while (!std::filesystem::exists(there.parent_path())) there = there.parent_path();
  checkWritable(there);
}

void writeAtomically(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.close();
}

}  // namespace redbee
