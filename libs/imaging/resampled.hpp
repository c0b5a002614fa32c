// cv::resize(): not where nothing changes, and where it takes a pixel from.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

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

/// The map itself, not copied, if it has that size already.
inline cv::Mat1f resized(const cv::Mat1f& map, cv::Size size, int interpolation = cv::INTER_LINEAR) {
  if (map.size() == size) return map;
  cv::Mat1f to;
  cv::resize(map, to, size, 0, 0, interpolation);
  return to;
}

}  // namespace redbee
