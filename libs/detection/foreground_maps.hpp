#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// A background model's classification of an image, of the image's full size.
struct ForegroundMaps {
  cv::Mat1b foreground;  ///< P_FG * 255: 255 where the pixel is known and not background
  cv::Mat1b unknown;     ///< 255 where no earlier frame shows the scene, or too few do
};

}  // namespace redbee
