// Grey-scale reconstruction (Vincent, "Morphological grayscale reconstruction in image analysis", 1993).
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Reconstruction by dilation of the marker `level` under the mask `limit` (4-connected), in place. Both have
/// the same size, level <= limit. Approximate: a fixed number of sweeps, which strongly winding paths exceed.
void reconstruct(const cv::Mat1f& limit, cv::Mat1f& level);

/// Fills the holes of `map` (0..1): a region enclosed by higher values is raised to the lowest value on its
/// outline. Gaps in the outline up to `gap_px` are closed first; outlines below 0.02 are ignored.
void fillHoles(cv::Mat1f& map, int gap_px);

}  // namespace redbee
