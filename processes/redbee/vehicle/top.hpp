// redbee top: the health of the processes, as `top` shows it.
#pragma once

#include <string>

namespace redbee {

struct TopOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";
  bool once = false;      ///< one plain table instead of a screen
  double listen_s = 2.2;  ///< how long to listen for it: two messages of each process
};

/// Until q, SIGINT or SIGTERM; with `once` for `listen_s`. Number of processes that published their health.
int runTop(const TopOptions& options);

}  // namespace redbee
