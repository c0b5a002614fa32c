// The library counts in microseconds between messages and in seconds within equations.
#pragma once

#include <cstdint>

namespace redbee {

inline double seconds(int64_t us) { return static_cast<double>(us) * 1e-6; }

}  // namespace redbee
