// Images and maps warped by homographies. Convention of imaging and detection: assigning a cv::Mat shares its
// memory. A function does not write to an image passed by const reference and returns one with its own
// memory; an image passed by reference is modified in place.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/homography.hpp"

namespace redbee {

cv::Matx33d toMatx(const Eigen::Matrix3d& H);

/// Warps an image or map of any type into the current frame: out(x) = map(H^-1 x), H previous to current; 0
/// outside of the map. `interpolation`: cv::InterpolationFlags. The result has its own memory.
cv::Mat warpToCurrent(const cv::Mat& map, const cv::Matx33d& H, int interpolation);
cv::Mat warpToCurrent(const cv::Mat& map, const Eigen::Matrix3d& H, int interpolation);

/// 255 where H^-1 maps a current pixel into the previous image, else 0.
cv::Mat1b overlapMask(const cv::Size& size, const cv::Matx33d& H);
cv::Mat1b overlapMask(const cv::Size& size, const Eigen::Matrix3d& H);
/// 255 where a current pixel, or a neighbour of it, was outside of the previous image, else 0.
cv::Mat1b outsidePrevious(const cv::Matx33d& H, cv::Size size);

/// True if H is finite and can be inverted.
bool isUsableHomography(const Eigen::Matrix3d& H);

/// Maps full-size pixels to those of an image `downscale` times smaller, whose pixels are means of blocks.
Eigen::Matrix3d downscaling(double downscale);
/// Size of that image.
cv::Size shrunkSize(cv::Size full, double downscale);

/// Image motion, from an earlier frame to the current one, of a scene with ground up to the horizon and
/// infinite depth above it. Without a camera motion the whole image is treated as ground.
struct SceneMotion {
  SceneMotion(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion,
              const CameraPair& cameras);

  Eigen::Matrix3d ground;      ///< homography, earlier to current pixels
  Eigen::Matrix3d far;         ///< the same above the horizon
  Eigen::RowVector3d horizon;  ///< horizon (x, y, 1) > 0 where a current pixel shows ground

  /// Where row y of the current image, `width` px wide, crosses the horizon.
  struct HorizonCut {
    int at;             ///< px: first pixel beyond the crossing, 0..width
    bool ground_first;  ///< the row begins with ground
  };
  HorizonCut cutAtHorizon(int y, int width) const;
};

}  // namespace redbee
