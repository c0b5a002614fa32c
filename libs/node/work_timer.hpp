// What the work on one frame took. For the figures only: no answer depends on it.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

#include "redbee/node/health.hpp"

namespace redbee {

class WorkTimer {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Processor time of this thread: unlike wall time it is the same on a busy machine, or nearly.
class CpuTimer {
 public:
  /// From here on the frame's answer is known, and is only made into messages.
  void answered() { answered_ = now(); }
  CpuTime share() const {
    const double end = now();
    const double answered = answered_ > 0 ? answered_ : end;
    return {answered - start_, end - answered};
  }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
  double answered_ = 0;
};

/// Of the work on one frame, from when it was its turn.
struct FrameTimers {
  WorkTimer wall;
  CpuTimer cpu;
};

/// `arrival`: since the frame was taken in.
inline void noteDone(HealthMonitor& health, int64_t utime, const WorkTimer& arrival,
                     const FrameTimers& timers) {
  health.notePublished(utime);
  health.noteLatency(arrival.milliseconds());
  health.noteWork(timers.wall.milliseconds());
  health.noteCpu(timers.cpu.share());
}

/// Something that waits for its turn.
template <typename Content>
struct Arrived {
  Content content;
  WorkTimer since;
};

}  // namespace redbee
