// Bad input, reported in one line.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace redbee {

/// what() is one line: "file[:line]: what is wrong". The tool prints it and exits with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& line) : std::runtime_error(line) {}
  InputError(const std::filesystem::path& file, const std::string& what)
      : std::runtime_error(file.string() + ": " + what) {}
  InputError(const std::filesystem::path& file, int line, const std::string& what)
      : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what) {}
};

}  // namespace redbee
