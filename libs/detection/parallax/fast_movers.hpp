// Whether much of the image moves so fast that the previous frame is a better reference than an earlier one.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

class FastMovers {
 public:
  /// `fast_px`: of the flow, from there on.
  FastMovers(bool are_counted, double fast_px)
      : are_counted_(are_counted), fast_px_(static_cast<float>(fast_px)) {}

  /// A row of the image; few of them and of their pixels are looked at. `residual`: normalized, of the flow.
  void count(int y, const cv::Mat2f& flow, const cv::Mat1b& unknown, const cv::Vec2f* residual) {
    constexpr float kSureSigmas = 3;
    constexpr int kStep = 8;
    if (!are_counted_ || y % kStep != kStep / 2) return;
    for (int x = kStep / 2; x < flow.cols; x += kStep) {
      if (unknown(y, x) != 0) continue;
      ++known_;
      if (cv::norm(residual[x]) > kSureSigmas && cv::norm(flow(y, x)) > fast_px_) ++fast_;
    }
  }
  bool areMany() const {
    constexpr double kFraction = 0.02;  // of the image
    return fast_ > kFraction * known_;
  }

 private:
  bool are_counted_;
  float fast_px_;
  int known_ = 0, fast_ = 0;
};

}  // namespace redbee
