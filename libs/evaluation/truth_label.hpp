// The values of a ground truth's pixels.
#pragma once

#include <cstdint>

namespace redbee {

/// Any other value is unknown.
inline constexpr uint8_t kTruthMoving = 255;
inline constexpr uint8_t kTruthStatic = 0;

}  // namespace redbee
