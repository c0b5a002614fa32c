// Rows of the guided filter, as vector code.
#pragma once

#include <cstddef>

namespace redbee {

/// A step of a running mean over a window of `side` pixels both ways, as cv::blur() computes it: sums in
/// double precision, mirrored at the border.
struct BoxRow {
  size_t width;
  int side;               ///< at most `width`
  const float* entering;  ///< row
  const float* leaving;   ///< null: none yet
  double* sums;           ///< of columns: width + side doubles, 0 at first
  float* mean;            ///< null: not yet
};
void boxMeanRow(const BoxRow& row);

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

/// slope * guide + offset; `to` may be one of them.
void applyModelRow(const float* slope, const float* offset, const float* guide, size_t width, float* to);

}  // namespace redbee
