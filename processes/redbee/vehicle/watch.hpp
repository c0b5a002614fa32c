// redbee watch: sees a process die at once, ends one that hangs, tells the ground, and wakes supervisor.
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

/// Hears of processes by their PROCESS_HEALTH and watches each by a file descriptor of it (pidfd_open(2)), so
/// that a death is seen when it happens and not when the next word is due.
class ProcessWatch {
 public:
  using Clock = std::chrono::steady_clock;

  ProcessWatch() = default;
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// Without a word for so long, while others are heard, a process hangs.
  static constexpr std::chrono::seconds kHangs{20};

  /// A process says how it fares. One that does not live on this host is not watched, nor is one that speaks
  /// but now and then (scripts: they have no configuration) thought to hang.
  void hear(const process_health_t& health, Clock::time_point now);

  /// Kills those that hang (SIGKILL: one that hangs hears nothing else). Their names.
  std::vector<std::string> endHanging(Clock::time_point now);

  /// Those that died since the last call: their last word, with the state made kDead and a message that says
  /// so.
  std::vector<process_health_t> takeDeaths();

 private:
  struct Watched {
    int fd = -1;
    process_health_t last;
    Clock::time_point heard;
  };
  static void forget(Watched& watched);

  std::map<std::string, Watched> watched_;
  Clock::time_point anyone_heard_ = Clock::time_point::min();
};

struct WatchOptions {
  std::filesystem::path configuration;
  std::string url;
};

/// Until SIGINT or SIGTERM. For half a second after a death a line is printed every 20 ms: supervisor 4.2
/// looks at its children when one of them prints, otherwise once a second (supervisord.py, runforever), and
/// needs two looks to start a process again.
void runWatch(const WatchOptions& options);

}  // namespace redbee
