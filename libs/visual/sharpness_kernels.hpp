// Sums of the gradients' products over a row, as vector code in integers: they are exact.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// Sums over the pixels of a row but the first and the last, g their gradient (3x3 Sobel).
struct GradientProducts {
  int64_t xx, xy, yy;
};
/// `rows`: the one above, the row, the one below; `width`: 2 to 2000 px (beyond, the sums of the steepest
/// gradients would not fit).
GradientProducts gradientProducts(const uint8_t* const rows[3], size_t width);

}  // namespace redbee
