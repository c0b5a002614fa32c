// Raw images to ideal ones, in which homographies hold, and back.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"

namespace redbee {

/// Look-up tables for one camera. Where raw and ideal pixels are the same it costs nothing: images pass
/// through uncopied.
class Rectifier {
 public:
  explicit Rectifier(const Camera& camera);

  /// Raw image to ideal image, of the size and K of the camera's ideal(), bilinear; black where unseen().
  cv::Mat toIdeal(const cv::Mat& raw) const;
  /// 8-bit map on the ideal grid (mask, probability) to the raw grid, nearest neighbour; `outside` where the
  /// raw pixel was not rectified.
  cv::Mat toRaw(const cv::Mat& ideal, uchar outside = 0) const;
  /// 8-bit, ideal grid: 255 where the raw image shows nothing, or the camera model has no pixel; empty if
  /// every pixel is seen.
  const cv::Mat& unseen() const { return unseen_; }

 private:
  cv::Mat to_ideal_1_, to_ideal_2_;
  cv::Mat to_raw_1_, to_raw_2_;
  cv::Mat unseen_;
};

}  // namespace redbee
