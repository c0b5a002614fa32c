#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Classification of an image by a background model, at the full image size.
struct ForegroundMaps {
  cv::Mat1b foreground;  ///< P_FG * 255: 255 where the pixel is known and not background
  cv::Mat1b unknown;     ///< 255 where too few earlier frames show the scene
  /// By how much a moving surface explains the image better than static ones do, over the noise (squares);
  /// 1 says nothing. Smaller than the image; empty if it is not known.
  cv::Mat1f gain{};
};

}  // namespace redbee
