// A result of `redbee doctor`.
#pragma once

#include <string>

namespace redbee {

struct Finding {
  bool good = false;
  std::string what;     ///< one line
  std::string fix;      ///< a command or a step; empty if nothing is wrong
  bool checked = true;  ///< false: what was heard does not show it, `fix` says what would; it does not fail
};

}  // namespace redbee
