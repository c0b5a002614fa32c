// Memory and processor time of this process.
#pragma once

#include <sys/resource.h>
#include <sys/time.h>

#include <cstdint>
#include <map>
#include <string>

#include "redbee/node/health.hpp"

namespace redbee {

/// Usage since the start of the process.
struct ProcessUsage {
  int64_t peak_resident_bytes = 0;
  double cpu_s = 0;                       ///< all threads, user and system
  std::map<std::string, CpuTime> stages;  ///< by the name of the stage: of its thread, all frames
};

inline ProcessUsage processUsage() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return {};
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {
      static_cast<int64_t>(usage.ru_maxrss) * 1024, seconds(usage.ru_utime) + seconds(usage.ru_stime), {}};
}

}  // namespace redbee
