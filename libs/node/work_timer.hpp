// Timers for one frame. For statistics only: no result depends on them.
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

/// Processor time of this thread: unlike wall time it hardly depends on the machine's load.
class CpuTimer {
 public:
  /// The frame's result is computed; what follows is encoding and publishing.
  void resultReady() { result_ready_ = now(); }
  CpuTime elapsed() const {
    const double end = now();
    const double ready = result_ready_ > 0 ? result_ready_ : end;
    return {ready - start_, end - ready};
  }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
  double result_ready_ = 0;
};

/// Timers of one frame, from the start of its processing.
struct FrameTimers {
  WorkTimer wall;
  CpuTimer cpu;
};

/// `arrival`: started when the frame was received.
inline void noteDone(HealthMonitor& health, CameraTime time, const WorkTimer& arrival,
                     const FrameTimers& timers) {
  health.notePublished(time.time_since_epoch());
  health.noteLatency(arrival.milliseconds());
  health.noteWork(timers.wall.milliseconds());
  health.noteCpu(timers.cpu.elapsed());
}

/// Something queued, with the time since its arrival.
template <typename Content>
struct Arrived {
  Content content;
  WorkTimer since;
};

}  // namespace redbee
