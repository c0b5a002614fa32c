// redbee top: shows the health of the processes continuously.
#pragma once

#include <string>

namespace redbee {

struct TopOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";
  bool once = false;      ///< print one table instead of a full-screen display
  double listen_s = 2.2;  ///< how long to listen for it: two messages of each process
};

/// Runs until q, SIGINT or SIGTERM; with `once` for `listen_s`. Returns the number of processes that
/// published their health.
int runTop(const TopOptions& options);

}  // namespace redbee
