// Common parts of the fuzz targets. LLVMFuzzerTestOneInput is called with one input
// (llvm.org/docs/LibFuzzer.html), by libFuzzer or by replay_main.cpp.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace redbee::fuzz {

/// A temporary folder of this process.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("redbee_fuzz_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Splits the input at lines "%%", for targets that take several files.
inline std::vector<std::string> parts(const uint8_t* data, size_t size, size_t count) {
  std::string rest(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> result;
  while (result.size() + 1 < count) {
    const size_t cut = rest.find("\n%%\n");
    result.push_back(rest.substr(0, cut));
    rest = cut == std::string::npos ? "" : rest.substr(cut + 4);
  }
  result.push_back(rest);
  return result;
}

}  // namespace redbee::fuzz
