// Who watches the watch: a process and its child, each of which ends the other where it hangs.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>

namespace redbee {

/// One end of the pair.
class Partner {
 public:
  using Clock = std::chrono::steady_clock;
  /// `fd`: a connected socket; `pidfd`: the partner.
  Partner(int fd, int pidfd, std::chrono::duration<double> timeout);
  ~Partner();
  Partner(const Partner&) = delete;
  Partner& operator=(const Partner&) = delete;

  enum class State { kAlive, kGone, kHung };
  /// Sends a sign of life and reads the partner's. Before its first one it may take kStartTimeout.
  State exchange(Clock::time_point now);
  /// SIGKILL to the partner, and to no other process that may have its number by now.
  void end() const;

  static constexpr std::chrono::seconds kStartTimeout{20};

 private:
  int fd_;
  int pidfd_;
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
