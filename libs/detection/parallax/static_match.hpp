// Asks the images themselves where the dense flow is in doubt: does a place on the parallax segment show what
// the current image shows? The flow's patches are wider than posts, trunks and branches; the comparison's are
// not.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/registration_error.hpp"

namespace redbee {

/// Reduces residuals that the images do not confirm. For each pixel whose residual is above one sigma, patches
/// along the segment are compared with the current image's (sum of squared differences, each patch less its
/// mean); what the best of them leaves beyond what the flow's own match leaves, over the grey levels' noise, is
/// the likelihood ratio of moving against static, and the residual becomes no longer than its root.
class StaticMatch {
 public:
  /// `grey`: the current image; `reference`: the earlier one, aligned; `flow`: px, from `grey` to `reference`;
  /// `error`: of the registration.
  StaticMatch(const cv::Mat1b& grey, const cv::Mat1b& reference, const cv::Mat2f& flow,
              const HomographyFlow& error, const ParallaxSegment& segment);

  void reduce(cv::Mat2f& normalized_residual, const cv::Mat1b& unknown);

 private:
  float difference(int x, int y, float reference_x, float reference_y) const;
  float bestStatic(int x, int y) const;
  float expected(int x, int y, const cv::Vec2f& back) const;
  float noiseVariance(const cv::Mat2f& normalized_residual, const cv::Mat1b& unknown) const;

  const cv::Mat1b& grey_;
  const cv::Mat1b& reference_;
  const cv::Mat2f& flow_;
  const HomographyFlow& error_;
  const ParallaxSegment& segment_;
};

}  // namespace redbee
