// The clock that our own drivers stamp measurements with: CLOCK_MONOTONIC, which starts with the computer and
// is never set. (Drones have no battery for their clock: the time of day jumps when the first satellite or
// time server is heard.)
#pragma once

#include <cstdint>
#include <ctime>

namespace redbee {

/// ns
inline int64_t hostNanoseconds() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace redbee
