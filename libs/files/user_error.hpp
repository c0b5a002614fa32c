// Base class of all errors that the user can correct: in a file, a configuration, an option.
#pragma once

#include <stdexcept>

namespace redbee {

/// what() is one line that states the place and the error. Programs print it and exit with status 2.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace redbee
