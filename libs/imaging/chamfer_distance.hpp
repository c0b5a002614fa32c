// Distances of pixels from a region, by steps to neighbours (Borgefors 1986), into memory that is there.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Distance of each pixel from the region [px], 0 in it; steps to a neighbour count 0.955, those to a
/// diagonal one 1.369, which is Euclid's distance within 5 %. `pixels`: not 0 where the region is, of the
/// size of `box`, at least one; `box`: where they are in `distance`.
void distanceOutside(const cv::Rect& box, const cv::Mat1b& pixels, cv::Mat1f distance);
/// The same of each of the region's pixels from what is not the region, which surrounds `pixels`, too; 0
/// where the region is not. Of one size.
void distanceInside(const cv::Mat1b& pixels, cv::Mat1f distance);

}  // namespace redbee
