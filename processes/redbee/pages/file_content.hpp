// Reads files into strings.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace redbee {

/// Content of a file; empty if it cannot be read.
inline std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

}  // namespace redbee
