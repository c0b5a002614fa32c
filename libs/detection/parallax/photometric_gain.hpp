// Which explains the image better, the flow or a static surface? The flow of a patch is that of its texture,
// which may be a trunk's beside the pixel; the pixel itself, compared in the image, tells them apart.
#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/registration_error.hpp"

namespace redbee {

/// Two images and where a pixel of the current one comes from in the earlier one, aligned to it. All of one
/// size.
struct ImagePair {
  cv::Mat1b current;
  cv::Mat1b earlier;
  cv::Mat2f flow;  ///< px: current to earlier
  /// px: ParallaxSegment::Residual::nearest of the flow, earlier to current, of a row. Rows are asked for in
  /// order.
  std::function<const cv::Vec2f*(int y)> nearest;
  HomographyFlow ground;  ///< px: of the ground, earlier to current (registrationError())
};

/// (E_s - E_u) / (noise^2 + E_u), at least 0: E is the squared difference of the images, mean of 3x3 pixels,
/// by the better of the two static explanations (s: the ground and the segment's nearest point) and by the
/// flow (u). `noise`: grey levels. kNotCompared where `where` is 0.
cv::Mat1f photometricGain(const ImagePair& images, const cv::Mat1b& where, double noise);

}  // namespace redbee
