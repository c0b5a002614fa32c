// Images and maps warped by homographies.
//
// The rule for all of imaging and detection: images share their memory when they are assigned (OpenCV). A
// function does not write to an image that it takes by const reference and returns one with memory of its
// own; what it takes by reference it changes in place.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/homography.hpp"

namespace redbee {

cv::Matx33d toMatx(const Eigen::Matrix3d& H);

/// An image or a map of any type as the current frame sees it: out(x) = map(H^-1 x), H previous to current. 0
/// where the map does not reach. `interpolation` is one of OpenCV's. The result has memory of its own.
cv::Mat carryMap(const cv::Mat& map, const cv::Matx33d& H, int interpolation);
cv::Mat carryMap(const cv::Mat& map, const Eigen::Matrix3d& H, int interpolation);

/// 255 where H^-1 takes a current pixel into the previous image, else 0.
cv::Mat1b overlapMask(const cv::Size& size, const cv::Matx33d& H);
cv::Mat1b overlapMask(const cv::Size& size, const Eigen::Matrix3d& H);
/// 255 where a current pixel, or a neighbour of it, was outside of the previous image, else 0.
cv::Mat1b outsidePrevious(const cv::Matx33d& H, cv::Size size);

/// True if H is finite and can be inverted.
bool isUsableHomography(const Eigen::Matrix3d& H);

/// Full-size pixels to those of an image `downscale` times smaller: a pixel of it is the mean of a block, so
/// its centre lies between theirs.
Eigen::Matrix3d downscaling(double downscale);
/// That image's size.
cv::Size shrunkSize(cv::Size full, double downscale);

/// How a scene of ground up to the horizon, and of things infinitely far away above it, moves in the image
/// from an earlier frame to the current one. Without a camera motion all of it is ground.
struct SceneMotion {
  SceneMotion(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion,
              const Eigen::Matrix3d& K);

  Eigen::Matrix3d ground;      ///< homography, earlier to current pixels
  Eigen::Matrix3d far;         ///< the same above the horizon
  Eigen::RowVector3d horizon;  ///< horizon (x, y, 1) > 0 where a current pixel shows ground

  /// Where the ground begins or ends along row y of the current image, `width` px wide.
  struct HorizonCut {
    int at;             ///< px: the first pixel of the other side, 0..width
    bool ground_first;  ///< the row begins with ground
  };
  HorizonCut cutAtHorizon(int y, int width) const;
};

}  // namespace redbee
