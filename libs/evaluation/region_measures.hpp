// DAVIS' measures of a mask (Perazzi et al. 2016): region similarity J and contour accuracy F.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace redbee {

/// Intersection over union of the two regions; 1 where both are empty. Not 0 belongs to the region.
double regionSimilarity(const cv::Mat1b& mask, const cv::Mat1b& truth);
/// F-measure of the contours: a contour's pixel is matched where the other contour passes within 0.8 % of the
/// image's diagonal. 1 where both have none.
double contourAccuracy(const cv::Mat1b& mask, const cv::Mat1b& truth);

/// Means over frames.
class RegionMeasures {
 public:
  /// `labels`: 255 moves, 0 does not, any other value is unknown and belongs to neither region. Throws
  /// std::invalid_argument on maps of different sizes.
  void add(const cv::Mat1b& mask, const cv::Mat1b& labels);

  int64_t frames() const { return frames_; }
  double j() const { return frames_ > 0 ? j_sum_ / static_cast<double>(frames_) : 0; }
  double f() const { return frames_ > 0 ? f_sum_ / static_cast<double>(frames_) : 0; }

 private:
  double j_sum_ = 0, f_sum_ = 0;
  int64_t frames_ = 0;
};

}  // namespace redbee
