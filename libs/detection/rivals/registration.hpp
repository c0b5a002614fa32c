// Registration of two successive images by one homography: pyramidal Lucas-Kanade on a grid, then RANSAC,
// both OpenCV's, as the authors of these methods use them.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/rivals/grid_flow.hpp"

namespace redbee {

/// Homography of `tracks`, previous to current, by RANSAC with this inlier distance [px]. std::nullopt if
/// fewer than 3 % of the sampled points (plus 8) are inliers, or H is not plausible for a camera motion (the
/// authors do not check).
std::optional<cv::Matx33d> registerTracks(const GridTracks& tracks, double inlier_px = 1.0);

class Registrar {
 public:
  explicit Registrar(const GridFlowParameters& parameters = {}) : flow_(parameters) {}

  void reset() { flow_.reset(); }
  bool hasPrevious() const { return flow_.hasPrevious(); }
  /// Registers the previous image to this one, which becomes the previous. std::nullopt for the first image
  /// and if registerTracks() fails.
  std::optional<cv::Matx33d> advance(const cv::Mat1b& grey) { return registerTracks(flow_.advance(grey)); }

 private:
  GridFlow flow_;
};

}  // namespace redbee
