// The inner loops of the inverse search on one level of the pyramid (inverse_search.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// Side of a patch [px]. A patch's row is one vector.
inline constexpr int kSearchPatch_px = 8;
/// Margin of the image that is searched [px]: patches may lie beyond its border.
inline constexpr int kSearchMargin_px = 16;

/// Sums over a patch: of the gradient of `from`, and of its products.
struct PatchGradients {
  float xx, xy, yy, x, y;
};

struct SearchLevel {
  int width, height;      ///< px
  int columns, rows;      ///< of patches
  int stride_px;          ///< between patches
  int iterations;         ///< of the descent, in either direction
  const uint8_t* from;    ///< width x height, continuous, as are its gradients
  const int16_t* from_x;  ///< gradient, 3x3 Sobel
  const int16_t* from_y;
  const uint8_t* to;  ///< with a margin of kSearchMargin_px: width + 2 margin bytes a row

  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  size_t patch(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  int toStride() const { return width + 2 * kSearchMargin_px; }
};

/// Sums over kSearchPatch_px pixels of row y, one for each column of patches.
void sumGradients(const SearchLevel& level, int y, PatchGradients* sums);

/// Flow of each patch: improves (u, v) [px], one element a patch, row by row. Neighbours are tried as well,
/// within each of eight stripes of patches.
void searchPatches(const SearchLevel& level, const PatchGradients* gradients, float* u, float* v);

/// The flow of pixels: the mean of the patches that cover it, by how well each explains it. `weights`: room
/// for 16 rows. (u, v): of patches. `flow`: of pixels, x and y alternating.
void densify(const SearchLevel& level, const float* u, const float* v, float* weights, float* flow);

}  // namespace redbee
