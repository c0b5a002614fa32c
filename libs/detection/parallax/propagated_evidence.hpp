// Evidence propagated along the flow: that of a moving object accumulates over frames, while noise, waves and
// leaves oscillate and cancel (libs/README.md, equation 28).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parameters.hpp"
#include "redbee/imaging/spare_maps.hpp"

namespace redbee {

/// Evidence of one frame, per pixel.
struct FrameEvidence {
  /// The normalized residual of the flow from the parallax segment, of a row. Rows are asked for in order,
  /// and again as long as they are one of the last three.
  std::function<const cv::Vec2f*(int y)> residual;
  cv::Mat2f flow;  ///< px: back along the flow, ground motion compensated
  float step = 1;  ///< of the flow that is one frame's
};

class PropagatedEvidence {
 public:
  explicit PropagatedEvidence(const ParallaxParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// `ground`: previous to current. The evidence is reset where `unknown` is not 0.
  void update(const FrameEvidence& now, const Eigen::Matrix3d& ground, const cv::Mat1b& unknown,
              SpareMaps& spare);

  /// 0..1: steady motion in one direction.
  const cv::Mat1f& motion() const { return motion_; }

 private:
  ParallaxParameters parameters_;
  cv::Mat4f moving_;  ///< E, V (2 channels) and L of equation 28
  cv::Mat1f motion_;
  std::vector<int32_t> places_;
  std::vector<double> sums_;
  std::vector<float> mean_residual_;
};

}  // namespace redbee
