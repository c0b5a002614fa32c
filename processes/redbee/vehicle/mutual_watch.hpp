// Who watches the watch: a process and its child, each of which ends the other where it hangs.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>

#include "processes/redbee/vehicle/silence.hpp"

namespace redbee {

/// One end of the pair.
class Partner {
 public:
  using Clock = std::chrono::steady_clock;
  struct Process {
    pid_t pid;
    int pidfd;
  };
  /// `fd`: a connected socket.
  Partner(int fd, const Process& partner, std::chrono::duration<double> timeout);
  ~Partner();
  Partner(const Partner&) = delete;
  Partner& operator=(const Partner&) = delete;

  enum class State { kAlive, kGone, kHung };
  /// Sends a sign of life and reads the partner's. Before its first one it may take kStartTimeout. To be
  /// called several times a second: a partner that waits for a processor does not hang meanwhile.
  State exchange(Clock::time_point now);
  /// SIGKILL to the partner, and to no other process that may have its number by now.
  void end() const;

  static constexpr std::chrono::seconds kStartTimeout{20};

 private:
  int fd_;
  Process partner_;
  Silence silence_;
  Clock::duration timeout_;
  Clock::time_point deadline_;
  Clock::time_point last_call_;
  Clock::time_point next_;
};

/// Forks. In the child, calls `work` with its partner, the parent, and returns 0. In the parent, passes
/// SIGTERM and SIGINT on to the child and returns its exit status; throws std::runtime_error if the child
/// hung, and was killed, or crashed.
int watchEachOther(std::chrono::duration<double> timeout, const std::function<void(Partner&)>& work);

}  // namespace redbee
