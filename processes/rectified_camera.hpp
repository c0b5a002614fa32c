// The camera of a node: raw images made ideal.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// Undistorted; both empty where there is no image. As much smaller than the camera's as was asked for.
struct IdealImage {
  cv::Mat grey;    ///< CV_8U
  cv::Mat colour;  ///< CV_8UC3, BGR; empty unless asked for
};

class RectifiedCamera {
 public:
  /// `downscale`: 1, 2 or 4, how much smaller ideal() makes images; it divides the camera's sides.
  explicit RectifiedCamera(const CameraIntrinsics& intrinsics, int downscale = 1);

  const Camera& camera() const { return camera_; }
  const Rectifier& rectifier() const { return rectifier_; }
  int downscale() const { return downscale_; }
  /// Empty for a image that is damaged (`health` is told) or not of the camera's size.
  IdealImage ideal(const image_t& message, bool wants_colour, HealthMonitor& health) const;

 private:
  Camera camera_;
  Rectifier rectifier_;
  int downscale_;
  Rectifier image_rectifier_;  ///< of the images that ideal() makes
};

}  // namespace redbee
