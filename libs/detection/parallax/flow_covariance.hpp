// Covariance of dense flow by the image's texture: along an edge the flow is not observed (aperture problem).
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// A symmetric 2x2 matrix: xx, xy, yy.
using Symmetric2f = cv::Vec3f;

struct FlowNoise {
  double sigma_px;      ///< px at full size, of the flow over good texture
  double min_gradient;  ///< grey levels per px, in an image four times smaller: doubles the variance
};

/// Covariance [px^2] of the flow of an image that is `scale` times smaller than the full one, of its size:
/// sigma^2 (I + min_gradient^2 S^-1), S the gradient matrix (structure tensor; Foerstner and Guelch 1987)
/// around each pixel. `grey` is reduced for it to a quarter of the full size, about the flow's own grid.
cv::Mat3f flowCovariance(const cv::Mat1b& grey, double scale, const FlowNoise& noise);

/// The variance along the direction in which it is the largest.
cv::Mat1f largestVariance(const cv::Mat3f& covariance);

}  // namespace redbee
