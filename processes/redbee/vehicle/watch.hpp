// redbee watch: detects a death at once, kills a process that hangs, reports both, and wakes supervisor.
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

/// Knows processes by their PROCESS_HEALTH and watches each by a file descriptor of it (pidfd_open(2)), so
/// that a death is detected when it happens and not when the next message is due.
class ProcessWatch {
 public:
  using Clock = std::chrono::steady_clock;

  ProcessWatch() = default;
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// A process without a message for this long, while others publish, hangs.
  static constexpr std::chrono::seconds kHangs{20};

  /// A process that does not run on this host is not watched. One that publishes only now and then (scripts:
  /// they have no configuration) is never considered to hang.
  void onHealth(const process_health_t& health, Clock::time_point now);

  /// Kills the processes that hang (SIGKILL: they react to nothing else). Their names.
  std::vector<std::string> killHanging(Clock::time_point now);

  /// Processes that died since the last call: the last message of each, with the state kDead and a message
  /// that reports the death.
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

/// Until SIGINT or SIGTERM. For half a second after a death a line is printed every 20 ms: supervisor 4.2
/// polls its children when one of them prints, otherwise once a second (supervisord.py, runforever), and
/// needs two polls to restart a process.
void runWatch(const WatchOptions& options);

}  // namespace redbee
