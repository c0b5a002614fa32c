// The rows of an image as floating-point numbers, which kernels take: of the image itself no such copy is
// kept.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

class FloatRows {
 public:
  /// `kept`: how many of the rows asked for last stay valid, if they are asked for in order.
  explicit FloatRows(const cv::Mat& image, int kept = 2)
      : image_(image), indices_(static_cast<size_t>(kept), -1), rows_(static_cast<size_t>(kept)) {}

  /// Channels interleaved.
  const float* operator()(int y) {
    if (image_.depth() == CV_32F) return image_.ptr<float>(y);
    const size_t k = static_cast<size_t>(y) % rows_.size();
    if (indices_[k] != y) image_.row(y).convertTo(rows_[k], CV_32F);
    indices_[k] = y;
    return rows_[k].ptr<float>();
  }

 private:
  cv::Mat image_;
  std::vector<int> indices_;
  std::vector<cv::Mat> rows_;
};

}  // namespace redbee
