// Grey-scale reconstruction (Vincent, "Morphological grayscale reconstruction in image analysis", 1993).
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Raises `level` to what its pixels reach: at each pixel the highest level at which a path of neighbours (of
/// four) leads to a pixel of `level` without ever falling below it in `limit`. Of one size; level <= limit.
/// Paths that wind more often than structures or objects do are not followed to their end.
void reconstruct(const cv::Mat1f& limit, cv::Mat1f& level);

/// `map` (0..1) with its holes filled: what is enclosed by an outline of higher values is raised to
/// the lowest value that must be crossed on the way to the border. Gaps in the outline up to `gap_px` are
/// closed first; outlines weaker than 0.02 are none.
cv::Mat1f fillHoles(const cv::Mat1f& map, int gap_px);

}  // namespace redbee
