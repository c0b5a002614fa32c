// Evidence propagated along the flow: that of a moving object accumulates over frames, while noise, waves and
// leaves oscillate and cancel (libs/README.md, equation 28).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"

namespace redbee {

/// Evidence of one frame, per pixel.
struct FrameEvidence {
  cv::Mat2f normalized_residual;  ///< of the flow from the parallax segment
  cv::Mat2f back_step;            ///< px: back along the flow by one frame, ground motion compensated
};

class PropagatedEvidence {
 public:
  explicit PropagatedEvidence(const ParallaxParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// `ground`: previous to current. The evidence is reset where `unknown` is not 0.
  void update(const FrameEvidence& now, const Eigen::Matrix3d& ground, const cv::Mat1b& unknown);

  /// 0..1: steady motion in one direction.
  cv::Mat1f motion() const;

 private:
  ParallaxParameters parameters_;
  cv::Mat4f moving_;  ///< E, V (2 channels) and L of equation 28
};

}  // namespace redbee
