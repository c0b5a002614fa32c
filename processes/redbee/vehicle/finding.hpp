// A result of `redbee doctor`.
#pragma once

#include <string>

namespace redbee {

struct Finding {
  bool good = false;
  std::string what;  ///< one line
  std::string fix;   ///< a command or a step; empty if nothing is wrong
};

}  // namespace redbee
