// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "redbee/files/new_file.hpp"

namespace redbee {

/// A PartialFile with a buffer, for many small writes. Write errors, such as a full disk, throw InputError
/// with the file's name.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path) : file_(std::move(path)) {}

  void write(const void* data, size_t size) { write({static_cast<const char*>(data), size}); }
  void write(std::string_view text);
  /// Without it no file remains.
  void close();
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  PartialFile file_;
  std::string buffer_;
};

/// Throws InputError, with its name, if a file could not be written there: to be asked before long work.
void checkWritable(const std::filesystem::path& path);

/// The same of files in a folder, which need not be there yet.
void checkWritableFolder(const std::filesystem::path& folder);

/// Writes a small file at once.
void writeAtomically(const std::filesystem::path& path, std::string_view content);

}  // namespace redbee
