// How badly earlier images, registered to the ground, explain the current one. What stands above the ground
// differs wherever its parallax shows; around an object on open ground nothing does.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

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
  /// them. 0 where one of them does not show the scene, and without any. Computed where complete() asks for
  /// it. Keeps the image (not copied). `K`: of the image [px].
  const cv::Mat1b& learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K);
  /// Of the last learn(): the map has its values in this part of it.
  void complete(const cv::Rect& part);

 private:
  void compute(int y, int begin, int end);

  EarlierFrames frames_;
  cv::Mat1b image_, map_;
  cv::Mat1b done_;  ///< not 0 where a stretch of a row has its values
  std::vector<ImageAlignment> earlier_;
  std::vector<uint8_t> grey_, unknown_;  ///< a row
  std::vector<float> variance_;
};

}  // namespace redbee
