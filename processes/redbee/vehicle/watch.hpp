// redbee watch: detects processes that exit or hang, kills hanging ones, reports both, and wakes supervisor.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "processes/redbee/vehicle/process_identity.hpp"
#include "processes/redbee/vehicle/silence.hpp"
#include "processes/redbee/vehicle/supervisor_client.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee {

/// How the message of a DEAD process begins that had ended in order.
inline constexpr const char* kStopped = "stopped, process ";

/// Watches the children of supervisor, each by a pidfd (pidfd_open(2)), so that an exit is detected
/// immediately. Which they are says supervisor, and that they live their heartbeats; PROCESS_HEALTH, which
/// anybody may have sent, only adds what a report of a death contains.
class ProcessWatch {
 public:
  using Clock = std::chrono::steady_clock;
  /// std::nullopt: supervisor does not answer.
  using AskSupervisor = std::function<std::optional<std::vector<SupervisedProcess>>()>;

  struct Options {
    pid_t supervisor = 0;  ///< parent of all that may be killed
    /// The processes that may be killed, by supervisor's name, with the program that each must run.
    std::map<std::string, std::filesystem::path> programs;
    std::chrono::duration<double> hang_timeout{2.0};
  };

  ProcessWatch(Options options, AskSupervisor ask);
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// A process that has just been started may take this long until its first heartbeat.
  static constexpr std::chrono::seconds kStartTimeout{20};

  /// Asks supervisor for its children.
  void refresh(Clock::time_point now);
  /// Returns false if this process is not watched (yet).
  bool onHeartbeat(pid_t pid, Clock::time_point now);
  /// Messages of others than the watched processes, and implausible ones, are counted, not kept.
  void onHealth(const process_health_t& health);
  int64_t strangers() const { return strangers_; }

  /// Kills hanging processes (SIGKILL, as they do not react to SIGTERM), each only if supervisor, its parent,
  /// its program and its start agree that it is the one that was watched. Returns their names. To be called
  /// several times a second: who waits for a processor, which others have, does not hang meanwhile.
  std::vector<std::string> killHanging(Clock::time_point now);

  /// The processes that exited since the last call: the last message of each, with the state kDead and a text
  /// that reports the exit.
  std::vector<process_health_t> drainDeaths();

 private:
  struct Watched {
    int fd = -1;
    pid_t pid = 0;
    int64_t start_ticks = 0;
    Clock::time_point deadline;  ///< for its next heartbeat
    bool killed = false;
    process_health_t last{};
    Silence silence{};
  };
  void watch(const SupervisedProcess& process, Clock::time_point now);
  bool isStillWatched(const std::string& name, const Watched& watched) const;
  void noteDeath(const std::string& name, Watched& watched);
  Clock::duration hangTimeout() const {
    return std::chrono::duration_cast<Clock::duration>(options_.hang_timeout);
  }

  Options options_;
  AskSupervisor ask_;
  std::map<std::string, Watched> watched_;  ///< by supervisor's name
  std::vector<process_health_t> deaths_;
  std::optional<Clock::time_point> last_look_;
  int64_t strangers_ = 0;
};

struct WatchOptions {
  std::filesystem::path configuration;
  std::string url;
};

/// Runs under supervisor until SIGINT or SIGTERM, as two processes that watch each other. Throws
/// UserError where supervisor did not start it.
int runWatch(const WatchOptions& options);

}  // namespace redbee
