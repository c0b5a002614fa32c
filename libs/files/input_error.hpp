// The error for bad input, reported in one line.
#pragma once

#include <filesystem>
#include <string>

#include "redbee/files/user_error.hpp"

namespace redbee {

/// what() is one line: "file[:line]: what is wrong". The tool prints it and exits with status 2.
class InputError : public UserError {
 public:
  explicit InputError(const std::string& line) : UserError(line) {}
  InputError(const std::filesystem::path& file, const std::string& what)
      : UserError(file.string() + ": " + what) {}
  InputError(const std::filesystem::path& file, int line, const std::string& what)
      : UserError(file.string() + ":" + std::to_string(line) + ": " + what) {}
};

}  // namespace redbee
