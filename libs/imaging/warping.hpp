// Images and maps warped by homographies.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/homography.hpp"

namespace redbee {

cv::Matx33d toMatx(const Eigen::Matrix3d& H);

/// The map as the current frame sees it: out(x) = map(H^-1 x), H previous to current. 0 where the map does
/// not reach. `interpolation` is one of OpenCV's.
cv::Mat carryMap(const cv::Mat& map, const Eigen::Matrix3d& H, int interpolation);

/// 255 where H^-1 takes a current pixel into the previous image, else 0.
cv::Mat overlapMask(const cv::Size& size, const Eigen::Matrix3d& H);

/// True where H is finite and can be inverted.
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
};

}  // namespace redbee
