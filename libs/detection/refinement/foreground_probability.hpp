// The foreground's probability from its temporal, spatial and entropy maps (paper III.B, equations 13 to 16).
// The maps belong to scene points, so they are warped by the ground homography from frame to frame.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"

namespace redbee {

class ForegroundProbability {
 public:
  explicit ForegroundProbability(const RefinementParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// Warps the maps by the ground homography (previous to current).
  void propagate(const Eigen::Matrix3d& ground);
  /// `foreground`: 0..1, the D_t of (13) and (14); `order`: 0..1, the E_t of (15), empty for none. Returns
  /// P_FG (16), 0..1.
  cv::Mat1f update(const cv::Mat1f& foreground, const cv::Mat1f& order);

 private:
  RefinementParameters parameters_;
  cv::Mat1f temporal_, spatial_, entropy_;  ///< empty before the first update
};

}  // namespace redbee
