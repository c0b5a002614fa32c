// Opening and closing of a mask by discs, with a bit a pixel.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// In place: cv::morphologyEx() by disc(opening_px), then by disc(closing_px); 0: not. `mask`: 0 or 255.
void openAndClose(cv::Mat1b& mask, int opening_px, int closing_px);

}  // namespace redbee
