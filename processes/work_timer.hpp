// How long the work on one frame took. For the figures only: no answer depends on it.
#pragma once

#include <chrono>
#include <cstdint>

#include "messaging/health.hpp"

namespace redbee {

class WorkTimer {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The configuration's seconds in the messages' unit.
inline int64_t microseconds(double seconds) { return static_cast<int64_t>(seconds * 1e6); }

/// `arrival`: since the frame was taken in; `work`: since it was its turn.
inline void noteDone(HealthMonitor& health, int64_t utime, const WorkTimer& arrival, const WorkTimer& work) {
  health.notePublished(utime);
  health.noteLatency(arrival.milliseconds());
  health.noteWork(work.milliseconds());
}

/// Something that waits for its turn.
template <typename Content>
struct Arrived {
  Content content;
  WorkTimer since;
};

}  // namespace redbee
