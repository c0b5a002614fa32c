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

/// Covariance of the flow of one image, by its texture.
class FlowTexture {
 public:
  /// `grey`: `scale` times smaller than the full image. It is reduced to a quarter of the full size, about
  /// the flow's own grid.
  FlowTexture(const cv::Mat1b& grey, double scale);

  /// Covariance [px^2], of grey's size: sigma^2 (I + min_gradient^2 S^-1), S the gradient matrix (structure
  /// tensor; Foerstner and Guelch 1987) around each pixel.
  cv::Mat3f covariance(const FlowNoise& noise) const;

 private:
  cv::Mat3f gradients_;  ///< S, quarter-size
  cv::Size size_;
  double scale_;
};

/// The variance along the direction in which it is the largest.
float largestVariance(const Symmetric2f& covariance);
cv::Mat1f largestVariance(const cv::Mat3f& covariance);

}  // namespace redbee
