// How badly earlier images, registered to the ground, explain the current one. What stands above the ground
// differs wherever its parallax shows; around an object on open ground nothing does.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/parallax/earlier_frames.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

class GroundDifference {
 public:
  void reset() { frames_.reset(); }
  /// The camera's motion to the next image (previous to current, pixels of the images).
  void propagate(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion) {
    frames_.propagate(ground, motion);
  }
  /// 255 d^2 / (d^2 + noise^2 + (tolerance * slope)^2) of the difference d of grey values, the least over
  /// images a sixth, a third and half of a second old: where an object has left, the background is in one of
  /// them. 0 where one of them does not show the scene, and without any. Keeps the image (not copied). `K`:
  /// of the image [px].
  cv::Mat1b learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K);

 private:
  EarlierFrames frames_;
};

}  // namespace redbee
