// Connected regions of a mask, for the components of the foreground.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/connected_regions.hpp"

namespace redbee {

/// For morphology.
inline cv::Mat1b disc(int diameter) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {diameter, diameter});
}

/// Calls work(box, area, pixels of the region in the box) for each connected region that is large enough.
template <typename Work>
void forEachRegion(const cv::Mat1b& mask, double min_area_px, const Work& work) {
  const ConnectedRegions regions(mask);
  for (size_t i = 0; i < regions.size(); ++i) {
    if (regions.area(i) >= min_area_px) work(regions.box(i), regions.area(i), regions.pixels(i));
  }
}

/// Mean of a map, of any size, around a box of an image of size `image`: as far as the box's longer side,
/// beyond what the object's own flow reaches. 1 if nothing is known there.
double meanAround(const cv::Mat1f& map, cv::Size image, const cv::Rect& box);

}  // namespace redbee
