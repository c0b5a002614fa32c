// What the ground's homography leaves of the motion of everything that stands still: a smooth error of
// registration, which would otherwise add up to evidence of motion.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "segmentation/parallax_segment.hpp"

namespace redbee {

/// A flow that is affine in the pixel.
struct AffineFlow {
  Eigen::Matrix<float, 2, 3> A = Eigen::Matrix<float, 2, 3>::Zero();
  cv::Vec2f at(float x, float y) const {
    return {A(0, 0) * x + A(0, 1) * y + A(0, 2), A(1, 0) * x + A(1, 1) * y + A(1, 2)};
  }
};

/// The affine part of the flow across the direction of parallax (where there is no parallax, of all of it),
/// robustly over the picture: static surfaces agree on it whatever their depth, what moves does not.
/// `flow`: CV_32FC2, px, from the current picture to the earlier one that the ground's homography has laid
/// onto it; `variance`: CV_32F, px^2, of the flow; `unseen`: CV_8U, not 0 where the flow means nothing;
/// `expected_px`: how large an error is expected, a weak prior. The result points like the flow of `segment`,
/// from the earlier picture to the current one.
AffineFlow registrationError(const cv::Mat& flow, const cv::Mat& variance, const cv::Mat& unseen,
                             const ParallaxSegment& segment, float expected_px);

}  // namespace redbee
