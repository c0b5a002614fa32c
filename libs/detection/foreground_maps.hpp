#pragma once

#include <functional>
#include <opencv2/core.hpp>

namespace redbee {

/// Of ForegroundMaps::gain and residual: a pixel that says nothing.
constexpr float kNotCompared = -1;

/// Classification of an image by a background model, at the full image size.
struct ForegroundMaps {
  cv::Mat1b foreground;  ///< P_FG * 255: 255 where the pixel is known and not background
  cv::Mat1b unknown;     ///< 255 where too few earlier frames show the scene
  /// Photometric gain: by how much a moving surface explains the image better than static ones do, over the
  /// noise (squares). kNotCompared where it is not computed. Of any size; empty if it is not known.
  cv::Mat1f gain{};
  /// Squared length of the flow's normalized residual. Of any size; empty if there is no flow.
  cv::Mat1f residual{};
  /// movingRegion(): around points whose path no static surface explains, 0..1. Of any size; empty if there
  /// are none.
  cv::Mat1f moving{};
  /// What candidates are judged by (objects/candidates.hpp), of one size, or all empty. 0 to 255: the
  /// difference of appearance to the background (29), the evidence of motion M / (M + half) (30), and
  /// GroundDifference.
  cv::Mat1b appearance{}, motion{}, ground{};
  /// `ground` has values where this has been called for it, until the next frame; empty: everywhere.
  std::function<void(const cv::Rect&)> complete_ground{};
  cv::Mat4b colours{};  ///< the image that they are of: blue, green, red, unused
};

}  // namespace redbee
