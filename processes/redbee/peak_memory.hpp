#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace redbee {

/// Largest resident size of this process so far [bytes].
inline int64_t peakResidentBytes() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<int64_t>(usage.ru_maxrss) * 1024 : 0;
}

}  // namespace redbee
