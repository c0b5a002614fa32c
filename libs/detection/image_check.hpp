// What an image is good for: black, blank and noisy ones must not be learned, repeated ones have nothing new.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

enum class ImageContent {
  kNew,
  kRepeated,  ///< shows the same moment as the reference
  kFrozen,    ///< the same as the reference to the bit, which sensor noise rules out
  kUnusable,  ///< empty, of too little contrast, or pure noise
};

class ImageCheck {
 public:
  /// `min_contrast`: standard deviation [grey levels] below which an image is black or blank.
  explicit ImageCheck(double min_contrast) : min_contrast_(min_contrast) {}

  void reset() { reference_.release(); }
  /// `downscale`: of the image.
  ImageContent classify(const cv::Mat1b& grey, int downscale) const;
  /// The image that later ones are compared with.
  void setReference(const cv::Mat1b& grey) { reference_ = grey.clone(); }

 private:
  double min_contrast_;
  cv::Mat1b reference_;
};

}  // namespace redbee
