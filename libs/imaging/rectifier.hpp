// Raw images to ideal ones, in which homographies hold, and back.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"

namespace redbee {

/// Look-up tables for one camera. A camera without distortion costs nothing: images pass through uncopied.
class Rectifier {
 public:
  explicit Rectifier(const Camera& camera);

  /// Raw image to ideal image of the same size and K, bilinear; black where the raw image does not
  /// reach.
  cv::Mat toIdeal(const cv::Mat& raw) const;
  /// Map on the ideal grid (mask, probability) to the raw grid, nearest neighbour; 0 where the ideal image
  /// does not reach.
  cv::Mat toRaw(const cv::Mat& ideal) const;
  /// 255 where the ideal image has been seen by the raw one; empty for a camera without distortion.
  const cv::Mat& seen() const { return seen_; }

 private:
  cv::Mat to_ideal_1_, to_ideal_2_;
  cv::Mat to_raw_1_, to_raw_2_;
  cv::Mat seen_;
};

}  // namespace redbee
