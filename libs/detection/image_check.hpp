// Detects images that must not be learned from: black, blank, frozen, noise.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"

namespace redbee {

class ImageCheck {
 public:
  explicit ImageCheck(const SegmentationParameters& parameters) : min_contrast_(parameters.min_contrast) {}

  void reset() { previous_.release(); }
  /// 8-bit grey. False for an empty image, one with next to no contrast, one of pure noise, and one that
  /// repeats the previous image to the bit, which a sensor's noise never does.
  bool accepts(const cv::Mat& grey);

 private:
  double min_contrast_;
  cv::Mat previous_;
};

}  // namespace redbee
