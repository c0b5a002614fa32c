// Edge-aware smoothing (He, Sun and Tang, "Guided image filtering", ECCV 2010; on a shrunk image: He and
// Sun, "Fast guided filter", 2015).
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// `map` as a locally linear function of `guide` (CV_8U or CV_32F) over windows of 2 radius + 1 px: smooths
/// within surfaces and preserves their edges. `contrast` [grey levels]: lower contrast is smoothed over (sqrt
/// of the regularisation).
cv::Mat1f guidedFilter(const cv::Mat& guide, const cv::Mat1f& map, int radius_px, double contrast);

}  // namespace redbee
