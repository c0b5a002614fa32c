// redbee watch: detects processes that exit or hang, kills hanging ones, reports both, and wakes supervisor.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

/// Learns of processes from PROCESS_HEALTH and watches each by a pidfd (pidfd_open(2)), so that an exit is
/// detected immediately.
class ProcessWatch {
 public:
  using Clock = std::chrono::steady_clock;

  ProcessWatch() = default;
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// A process without a message for this long, while others publish, is considered to hang.
  static constexpr std::chrono::seconds kHangTimeout{20};

  /// Processes on other hosts are not watched. Publishers without a configuration (scripts) publish
  /// irregularly and are never considered to hang.
  void onHealth(const process_health_t& health, Clock::time_point now);

  /// Kills hanging processes (SIGKILL, as they do not react to SIGTERM). Returns their names.
  std::vector<std::string> killHanging(Clock::time_point now);

  /// The processes that exited since the last call: the last message of each, with the state kDead and a text
  /// that reports the exit.
  std::vector<process_health_t> drainDeaths();

 private:
  struct Watched {
    int fd = -1;
    process_health_t last;
    Clock::time_point received;
  };
  static void stopWatching(Watched& watched);

  std::map<std::string, Watched> watched_;
  Clock::time_point newest_message_ = Clock::time_point::min();
};

struct WatchOptions {
  std::filesystem::path configuration;
  std::string url;
};

/// Runs until SIGINT or SIGTERM. For half a second after an exit it prints a line every 20 ms: supervisor 4.2
/// polls its children when one of them prints, otherwise once a second (supervisord.py, runforever), and
/// needs two polls to restart a process.
void runWatch(const WatchOptions& options);

}  // namespace redbee
