// Contrast of a region to what is just beyond its outline, by direction. What goes on beyond it has a sector
// without contrast: a piece of a post has two, at its ends.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Grey levels, the greatest of the channels' differences between the means just inside and just outside of
/// the outline, over the eight sectors around the region's centre. The sectors are equal where the region's
/// second moments are scaled to those of a disc. Not a number where there is no such sector.
struct OutlineContrast {
  float least, second, median, mean;
};

/// Distance from the region: it is compared to what is further than `begins` and no further than `ends` [px].
struct OutlineRing {
  float begins, ends;
};

/// `depth`: of the region's pixels from what is outside of it, 0 where it is not, of the size of `box`.
/// `around`: contains the box; `distance`: of its pixels from the region. `colours`: blue, green, red,
/// unused.
OutlineContrast outlineContrast(const cv::Mat4b& colours, const cv::Rect& box, const cv::Mat1f& depth,
                                const cv::Rect& around, const cv::Mat1f& distance, const OutlineRing& ring);

}  // namespace redbee
