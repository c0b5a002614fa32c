// Rectification: raw images to ideal images, between which homographies hold, and back.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"

namespace redbee {

/// Look-up tables for one camera. If raw and ideal pixels are the same, images are returned without a copy.
class Rectifier {
 public:
  /// `own_parts`: 255 where raw images show the vehicle itself, which is unknown, too; of the raw images'
  /// size, or empty. Throws std::invalid_argument for another size.
  explicit Rectifier(const Camera& camera, const cv::Mat1b& own_parts = {});

  /// Raw image to ideal image, of the size and K of the camera's ideal(), bilinear; black where unknown().
  cv::Mat toIdeal(const cv::Mat& raw) const;
  /// Map on the ideal grid (mask, probability) to the raw grid, nearest neighbour; `outside` where the raw
  /// pixel lies outside the ideal image.
  cv::Mat1b toRaw(const cv::Mat1b& ideal, uchar outside = 0) const;
  /// On the ideal grid: 255 where the raw image or the camera model has no pixel, and where the vehicle's own
  /// parts are; empty if all pixels are known.
  const cv::Mat1b& unknown() const { return unknown_; }
  /// On the ideal grid: 255 where the vehicle's own parts are; empty if there are none.
  const cv::Mat1b& ownParts() const { return own_parts_; }

 private:
  cv::Mat to_ideal_1_, to_ideal_2_;
  cv::Mat to_raw_1_, to_raw_2_;
  cv::Mat1b unknown_;
  cv::Mat1b own_parts_;
};

}  // namespace redbee
