// The rows of an image as floating-point numbers, which the kernels take: of the image itself no such copy is
// kept.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace redbee {

class FloatRows {
 public:
  explicit FloatRows(const cv::Mat4b& image) : image_(image) { kept_.fill(-1); }

  /// Four channels, interleaved; valid until rows further on are asked for: the last two are kept.
  const float* operator()(int y) {
    const auto k = static_cast<size_t>(y) % kept_.size();
    if (kept_[k] != y) image_.row(y).convertTo(rows_[k], CV_32F);
    kept_[k] = y;
    return rows_[k].ptr<float>();
  }

 private:
  cv::Mat4b image_;
  std::array<int, 2> kept_{};
  std::array<cv::Mat4f, 2> rows_;
};

}  // namespace redbee
