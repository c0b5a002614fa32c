// Files of our own: what another user has put under their name, such as a link, is never written through.
#pragma once

#include <filesystem>
#include <string_view>

namespace redbee {

/// An open file descriptor, closed at the end.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor();

  int get() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }
  /// Writes all of it. Returns false, with errno, where the disk does not take it.
  bool write(std::string_view bytes) const;
  /// Returns false, with errno, if what was written did not reach the disk.
  bool close();

 private:
  int fd_;
};

/// Creates the file (O_EXCL, O_NOFOLLOW); not open, with errno EEXIST, where there is anything of that name.
FileDescriptor createFile(const std::filesystem::path& path);

/// A file "<path>.partial" that becomes `path` when it is complete; otherwise it is removed. One that an
/// earlier run left there, or a link, is removed first. Throws InputError, with the name of `path`, if it
/// cannot be written or if `path` is anything but a regular file.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A name by which a library that takes only names opens this very file, while it is open.
  std::filesystem::path descriptorPath() const;
  void write(std::string_view bytes);
  void commit();
  bool isOpen() const { return file_.isOpen(); }

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  FileDescriptor file_;
};

}  // namespace redbee
