// How long a process has been silent, and how much of that it waited for a processor.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>

namespace redbee {

/// Who waits for a processor, which others have, does not hang: on a machine that is overloaded what has a
/// low priority takes long between two signs of life.
class Silence {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kMostWaited{60};

  /// A sign of life.
  void end(Clock::time_point now) {
    since_ = now;
    ran_.reset();
    waited_ = Clock::duration::zero();
  }
  /// Of the period up to now, since the last call: how much the process waited for a processor; none if it is
  /// not silent for long, or has been credited with kMostWaited. To be called several times a second.
  Clock::duration waited(pid_t pid, Clock::time_point now, Clock::duration period);

 private:
  Clock::time_point since_{};
  std::optional<std::chrono::nanoseconds> ran_{};  ///< when it was last looked at in its silence
  Clock::duration waited_{};                       ///< in this silence
};

}  // namespace redbee
