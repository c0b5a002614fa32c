// The base of all errors that the user can correct: a file, a configuration, an option.
#pragma once

#include <stdexcept>

namespace redbee {

/// what() is one line that names the place and the fault. Programs print it and exit with 2.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace redbee
