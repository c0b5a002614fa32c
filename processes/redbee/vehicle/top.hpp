// redbee top: how the processes fare, as `top` shows it.
#pragma once

#include <string>

namespace redbee {

struct TopOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";
  bool once = false;      ///< one plain table instead of a screen
  double listen_s = 2.2;  ///< how long to listen for it: two words of everyone
};

/// Until q, SIGINT or SIGTERM; with `once` until it has listened. Processes heard.
int runTop(const TopOptions& options);

}  // namespace redbee
