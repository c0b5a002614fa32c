// redbee announce: one word on PROCESS_HEALTH, for scripts.
#pragma once

#include <string>

namespace redbee {

struct AnnounceOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";
  std::string process;         ///< who speaks
  std::string state = "good";  ///< starting, good, degraded, stopping, dead
  std::string message;
  int process_id = 0;  ///< of who speaks
};

/// Throws InputError for a state that is none.
void runAnnounce(const AnnounceOptions& options);

}  // namespace redbee
