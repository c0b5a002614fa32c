// Evidence propagated along the flow: a moving object's evidence adds up from frame to frame; noise, waves
// and leaves oscillate, and their vectors cancel (libs/README.md, equation 28).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"

namespace redbee {

/// Evidence of one frame, per pixel.
struct FrameEvidence {
  cv::Mat2f normalized_residual;  ///< flow off the parallax segment over its standard deviation
  cv::Mat2f back_step;            ///< px: back along the flow by one frame, ground's motion taken out
};

class TravellingEvidence {
 public:
  explicit TravellingEvidence(const ParallaxParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// `ground`: previous to current. Nothing is kept where `unknown` is not 0.
  void update(const FrameEvidence& now, const Eigen::Matrix3d& ground, const cv::Mat1b& unknown);

  /// 0..1: steady motion in one direction.
  cv::Mat1f motion() const;

 private:
  ParallaxParameters parameters_;
  cv::Mat4f moving_;  ///< mean evidence, mean vector off the segment (2), mean length of it
};

}  // namespace redbee
