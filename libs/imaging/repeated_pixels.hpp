// Enlarging a mask.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// cv::resize() with INTER_NEAREST, fast where both sides double, once or twice.
cv::Mat1b repeatedPixels(const cv::Mat1b& mask, cv::Size size);

}  // namespace redbee
