// What may be read as a file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "redbee/files/input_error.hpp"

namespace redbee {

/// rtsp://10.87.0.1/live and the like, which a path keeps as they are.
inline bool isAddress(const std::filesystem::path& file) {
  return file.native().find("://") != std::string::npos;
}
inline constexpr const char* kAddressFault =
    "is an address, not a file: record it first (ffmpeg -i ADDRESS -c copy F.mp4), or give it to "
    "redbee-camera "
    "(capture.pipeline)";

/// Empty for a regular file and for a link to one, otherwise what else it is: a pipe would be waited for
/// for ever, and a device may never end.
inline std::string faultOfFile(const std::filesystem::path& file) {
  std::error_code error;
  switch (std::filesystem::status(file, error).type()) {
    case std::filesystem::file_type::regular:
      return "";
    case std::filesystem::file_type::not_found:
      return isAddress(file) ? kAddressFault : "no such file";
    case std::filesystem::file_type::directory:
      return "is a folder, not a file";
    case std::filesystem::file_type::fifo:
      return "is a pipe, not a file";
    case std::filesystem::file_type::character:
    case std::filesystem::file_type::block:
      return "is a device, not a file";
    case std::filesystem::file_type::socket:
      return "is a socket, not a file";
    default:
      return error ? "cannot be read: " + error.message() : "is no file";
  }
}

/// Empty, or what stands in a file's place by its first bytes: no command reads these, and each has its fix.
inline std::string faultOfContent(const std::filesystem::path& file) {
  using std::string_view_literals::operator""sv;
  struct Kind {
    std::string_view start;
    const char* fault;
  };
  static constexpr std::array<Kind, 10> kKinds{
      {{"version https://git-lfs.github.com/spec/"sv,
        "is a pointer of Git LFS, not the file it stands for: fetch that with git lfs pull"},
       {"SQLite format 3\0"sv,
        "is a ROS 2 bag in SQLite, import mcap reads MCAP: ros2 bag convert -i BAG -o o.yaml, where o.yaml "
        "says "
        "output_bags: [{uri: OUT, storage_id: mcap, all: true}]"},
       {"PK\x03\x04"sv, "is a ZIP archive: unpack it first"},
       {"7z\xBC\xAF\x27\x1C"sv, "is a 7z archive: unpack it first"},
       {"\xFF\xFE"sv, "is text in UTF-16, as spreadsheets export \"Unicode text\": save it as UTF-8"},
       {"\xFE\xFF"sv, "is text in UTF-16, as spreadsheets export \"Unicode text\": save it as UTF-8"},
       {"\x1F\x8B"sv, "is packed by gzip: unpack it first (gzip -d)"},
       {"\x28\xB5\x2F\xFD"sv, "is packed by Zstandard: unpack it first (zstd -d)"},
       {"\xFD\x37zXZ"sv, "is packed by xz: unpack it first (xz -d)"},
       {"BZh"sv, "is packed by bzip2: unpack it first (bzip2 -d)"}}};
  std::string bytes(kKinds.front().start.size(), '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  for (const auto& [start, fault] : kKinds) {
    if (bytes.compare(0, start.size(), start) == 0) return fault;
  }
  return "";
}

/// Empty for what may be read, otherwise what it is instead.
inline std::string faultOfInput(const std::filesystem::path& file) {
  const std::string fault = faultOfFile(file);
  return fault.empty() ? faultOfContent(file) : fault;
}

/// Throws InputError where there is a faultOfInput(). To be called before any file of the user's is opened.
inline void requireFile(const std::filesystem::path& file) {
  if (const std::string fault = faultOfInput(file); !fault.empty()) throw InputError(file, fault);
}

/// All bytes of a regular file.
inline std::vector<uint8_t> readWhole(const std::filesystem::path& file) {
  requireFile(file);
  std::ifstream in(file, std::ios::binary);
  std::vector<uint8_t> bytes(static_cast<size_t>(std::filesystem::file_size(file)));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw InputError(file, "cannot be read");
  return bytes;
}

/// Throws InputError unless it is a regular file that its owner and group alone may read. `what`: "key".
inline void requireSecret(const std::filesystem::path& file, const std::string& what) {
  using std::filesystem::perms;
  requireFile(file);
  std::error_code error;
  const perms open = std::filesystem::status(file, error).permissions() & perms::others_all;
  if (!error && open != perms::none)
    throw InputError(file, "every user may read this " + what + "; chmod o-rwx it, and change the " + what);
}

/// Throws InputError if two of them are one file, under whatever name.
inline void requireNoneTwice(const std::vector<std::filesystem::path>& files) {
  for (size_t i = 1; i < files.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (std::filesystem::equivalent(files[i], files[j], error))
        throw InputError(files[i], "is given twice");
    }
  }
}

/// Throws InputError if `output` is one of `inputs`, under whatever name: writing would destroy it.
inline void requireNoInput(const std::filesystem::path& output,
                           const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code error;
    if (std::filesystem::equivalent(output, input, error))
      throw InputError(output, "is also the input, and would be overwritten: give --out another name");
  }
}

}  // namespace redbee
