// Rows of the guided filter, as vector code.
#pragma once

#include <cstddef>

namespace redbee {

/// Mean over a window of `side` pixels both ways, as cv::blur() computes it: sums in double precision,
/// mirrored at the border. `rows`: `side` rows of `width` >= side pixels; `sums`: room for width + side
/// doubles.
void boxMeanRow(const float* const* rows, int side, size_t width, double* sums, float* mean);

/// The means of guide and map, of the guide's square and of their product; the map as a linear function of
/// the guide.
struct LinearModelRow {
  size_t width;
  const float* guide;
  const float* map;
  const float* guide_guide;
  const float* guide_map;
  float* slope;
  float* offset;
};
/// `contrast2`: added to the guide's variance.
void linearModelRow(const LinearModelRow& row, float contrast2);

/// slope * guide + offset.
void applyModelRow(const float* slope, const float* offset, const float* guide, size_t width, float* to);

}  // namespace redbee
