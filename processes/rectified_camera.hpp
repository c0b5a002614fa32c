// The camera of a node: raw pictures made ideal.
#pragma once

#include <opencv2/core.hpp>

#include "geometry/camera.hpp"
#include "messaging/health.hpp"
#include "redbee/image_t.hpp"
#include "visual/rectifier.hpp"

namespace redbee {

/// Undistorted; both empty where there is no picture.
struct IdealPicture {
  cv::Mat grey;    ///< CV_8U
  cv::Mat colour;  ///< CV_8UC3, BGR; empty unless asked for
};

class RectifiedCamera {
 public:
  explicit RectifiedCamera(const CameraIntrinsics& intrinsics) : camera_(intrinsics), rectifier_(camera_) {}

  const Camera& camera() const { return camera_; }
  const Rectifier& rectifier() const { return rectifier_; }
  /// Empty for a picture that is damaged (`health` is told) or not of the camera's size.
  IdealPicture ideal(const image_t& message, bool wants_colour, HealthMonitor& health) const;

 private:
  Camera camera_;
  Rectifier rectifier_;
};

}  // namespace redbee
