// Trees and facades, where no IMU tells how they move: their parallax looks like motion, but they run out of
// the image, as what moves seldom does over more than its own small width.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// What share of the evidence of motion hangs together with the image's border: at each pixel the highest
/// level at which a path leads to a stretch of the border at least `stretch_px` long without ever falling
/// below that level (grey-scale reconstruction; Vincent 1993), over the evidence itself. CV_32F, 0..1, of
/// `motion`'s size. `motion`: CV_32F, 0..1; `unseen`: CV_8U, 255 where it means nothing: the border is that
/// of what was seen.
cv::Mat fractionOfBorderStructure(const cv::Mat& motion, const cv::Mat& unseen, double stretch_px);

}  // namespace redbee
