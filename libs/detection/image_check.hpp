// Detects images that must not be learned from: black, blank, frozen, noise.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

class ImageCheck {
 public:
  /// `min_contrast`: grey levels, standard deviation below which an image is black or blank.
  explicit ImageCheck(double min_contrast) : min_contrast_(min_contrast) {}

  void reset() { previous_.release(); }
  /// False for an empty image, one with next to no contrast, one of pure noise, and one that
  /// repeats the previous image to the bit, which a sensor's noise never does.
  bool accepts(const cv::Mat1b& grey);

 private:
  double min_contrast_;
  cv::Mat1b previous_;
};

}  // namespace redbee
