// Base class of all errors that the user can correct: in a file, a configuration, an option.
#pragma once

#include <stdexcept>
#include <string>

#include "redbee/files/printable.hpp"

namespace redbee {

/// what() is one line that states the place and the error. Programs print it and exit with status 2.
class UserError : public std::runtime_error {
 public:
  /// Names out of files may be part of the line: it becomes printable().
  explicit UserError(const std::string& line) : std::runtime_error(printable(line)) {}
};

}  // namespace redbee
