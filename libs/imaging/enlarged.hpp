// Enlarging a map of bytes.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// cv::resize() with INTER_LINEAR, fast where both sides double.
cv::Mat1b enlarged(const cv::Mat1b& map, cv::Size size);

}  // namespace redbee
