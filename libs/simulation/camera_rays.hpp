// The rays of a camera's pixels.
#pragma once

#include <opencv2/core.hpp>
#include <stdexcept>

#include "redbee/geometry/camera.hpp"

namespace redbee::simulation {

/// x / z and y / z of every raw pixel, in C. Throws std::invalid_argument if a pixel's ray does not point
/// forward.
inline cv::Mat_<cv::Vec2f> raysOf(const Camera& camera) {
  const CameraIntrinsics& ideal = camera.ideal();
  cv::Mat_<cv::Vec2f> rays(camera.intrinsics().height, camera.intrinsics().width);
  for (int y = 0; y < rays.rows; ++y) {
    for (int x = 0; x < rays.cols; ++x) {
      const auto pixel = camera.undistort({x, y});
      if (!pixel) throw std::invalid_argument("the camera has pixels outside its model's domain");
      rays(y, x) = {static_cast<float>((pixel->x() - ideal.cx) / ideal.fx),
                    static_cast<float>((pixel->y() - ideal.cy) / ideal.fy)};
    }
  }
  return rays;
}

}  // namespace redbee::simulation
