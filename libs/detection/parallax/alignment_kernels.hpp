// Resampling of an earlier image in the current view, as vector code.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

struct EarlierImage {
  const uint8_t* pixels;
  size_t stride;
  int width, height;
};

struct AlignedRow {
  int y, begin, end;  ///< px, of the current view
  int32_t* places;    ///< room for twice end - begin
  uint8_t* grey;
  uint8_t* unknown;
};

/// Of at least one pixel. As cv::warpPerspective() has it: `grey` interpolated linearly, 0 beyond the border;
/// `unknown` 255 where the nearest pixel is not in the image, else 0. `back`: homography, current to earlier.
void alignPixels(const EarlierImage& image, const double back[9], const AlignedRow& row);

}  // namespace redbee
