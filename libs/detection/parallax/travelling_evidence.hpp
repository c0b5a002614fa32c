// Evidence propagated along the flow: a moving object's evidence adds up from frame to frame; noise, waves
// and leaves oscillate, and their vectors cancel (libs/README.md, equation 28).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"

namespace redbee {

/// Evidence of one frame, per pixel.
struct FrameEvidence {
  cv::Mat off;        ///< CV_32FC2: flow off the parallax segment over its standard deviation
  cv::Mat back_step;  ///< CV_32FC2, px: back along the flow by one frame, ground's motion taken out
};

class TravellingEvidence {
 public:
  explicit TravellingEvidence(const SegmentationParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// `ground`: previous to current. Nothing is kept where `unseen` is not 0.
  void update(const FrameEvidence& now, const Eigen::Matrix3d& ground, const cv::Mat& unseen);

  /// CV_32F, 0..1: steady motion in one direction.
  cv::Mat motion() const;

 private:
  SegmentationParameters parameters_;
  cv::Mat moving_;  ///< CV_32FC4: mean evidence, mean vector off the segment (2), mean length of it
};

}  // namespace redbee
