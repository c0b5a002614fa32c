// Where cv::resize() with linear interpolation takes a pixel from.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// One coordinate of a pixel of an image resized from `size` to `to_size`: between pixels `before` (-1 beyond
/// the border) and the next, `beyond` of the way.
struct Resampled {
  Resampled(int pixel, int size, int to_size) {
    const double scale = 1 / (static_cast<double>(to_size) / size);
    const auto at = static_cast<float>((pixel + 0.5) * scale - 0.5);
    before = cvFloor(at);
    beyond = at - static_cast<float>(before);
  }
  int before;
  float beyond;
};

}  // namespace redbee
