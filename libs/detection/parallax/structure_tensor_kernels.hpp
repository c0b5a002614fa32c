// Rows of the structure tensor, as vector code in integers: the sums are exact.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// Three rows of an image, vertically smoothed (1 2 1) and differentiated (-1 0 1): one value more to either
/// side of `smooth` and `difference` belongs to the caller.
void smoothAndDifference(const uint8_t* const rows[3], size_t width, int16_t* smooth, int16_t* difference);

/// Sums down the columns, and the products of the row that entered: of the gradient (3x3 Sobel) with itself,
/// xx, xy and yy, each `stride` values behind the one before.
struct TensorColumns {
  int32_t* sums;
  int32_t* products;  ///< in: those of the row that leaves; out: of the one that enters
  size_t stride;
};
void slideTensorColumns(const int16_t* smooth, const int16_t* difference, size_t width,
                        const TensorColumns& columns);

/// Sums over `side` columns times `scale`, interleaved. `sums`: of the first column of the first window.
void sumTensorRow(const int32_t* sums, size_t stride, int side, double scale, size_t width, float* tensor);

}  // namespace redbee
