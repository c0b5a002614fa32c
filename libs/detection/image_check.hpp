// Rejects images that must not be learned: black, blank, frozen, pure noise.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

class ImageCheck {
 public:
  /// `min_contrast`: standard deviation [grey levels] below which an image is black or blank.
  explicit ImageCheck(double min_contrast) : min_contrast_(min_contrast) {}

  void reset() { previous_.release(); }
  /// Returns false for an image that is empty, has too little contrast, is pure noise, or is identical to the
  /// previous one, which sensor noise rules out.
  bool accepts(const cv::Mat1b& grey);

 private:
  double min_contrast_;
  cv::Mat1b previous_;
};

}  // namespace redbee
