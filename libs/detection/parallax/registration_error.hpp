// The residual error of the ground homography: a smooth registration error, which would otherwise accumulate
// as evidence of motion.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parallax/flow_covariance.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"

namespace redbee {

/// The flow [px] of a homography close to the identity, to first order in its eight entries. Coordinates are
/// in units of half the image's width about its centre, so that all entries are in pixels.
struct HomographyFlow {
  explicit HomographyFlow(cv::Size image)
      : middle(0.5F * static_cast<float>(image.width), 0.5F * static_cast<float>(image.height)),
        unit(0.5F * static_cast<float>(image.width)) {}

  cv::Vec2f at(float x, float y) const {
    const float u = (x - middle[0]) / unit, v = (y - middle[1]) / unit;
    const float scale = perspective[0] * u + perspective[1] * v;
    return {affine(0, 0) * u + affine(0, 1) * v + affine(0, 2) + scale * u,
            affine(1, 0) * u + affine(1, 1) * v + affine(1, 2) + scale * v};
  }

  cv::Vec2f middle;
  float unit;
  Eigen::Matrix<float, 2, 3> affine = Eigen::Matrix<float, 2, 3>::Zero();
  cv::Vec2f perspective{0, 0};
};

/// Robust fit of a homography's flow to single components of flow at single pixels.
class HomographyFlowFit {
 public:
  explicit HomographyFlowFit(cv::Size image) : units_(image) {}

  void clear() { constraints_.clear(); }
  /// `measured_px`: component of the flow along the unit vector `normal` at `pixel`.
  void add(const cv::Vec2f& pixel, const cv::Vec2f& normal, float measured_px, float variance_px2);
  /// `expected_px`: sigma of a weak prior on the flow; `iterations`: of the reweighting.
  HomographyFlow solve(float expected_px, int iterations) const;

 private:
  struct Constraint {
    Eigen::Matrix<float, 8, 1> jacobian;
    float measured;  ///< px
    float variance;  ///< px^2
  };
  HomographyFlow units_;
  std::vector<Constraint> constraints_;
};

/// Robust fit of a homography's flow to the flow component perpendicular to the parallax (to both components
/// without parallax): static surfaces at any depth agree on it, moving objects do not. `flow`: px, from the
/// current image to the aligned earlier one; `noise`: of the flow; `unknown`: not 0 where the flow
/// is undefined; `expected_px`: sigma of a weak prior on the error. The result is from the earlier image to
/// the current one, like the flow of `segment`.
HomographyFlow registrationError(const cv::Mat2f& flow, const FlowCovariance& noise, const cv::Mat1b& unknown,
                                 const ParallaxSegment& segment, float expected_px);

}  // namespace redbee
