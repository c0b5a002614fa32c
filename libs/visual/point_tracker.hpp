// Tracks points on a regular grid from frame to frame by pyramidal Lucas-Kanade.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/imaging/pyramid.hpp"

namespace redbee {

struct TrackerParameters {
  int grid_px = 24;  ///< px between sample points, both ways (paper: 16); halved in images of little texture
  int window_px = 13;        ///< px, odd: side of the tracked patch
  int levels = 3;            ///< pyramid levels, 1 = the image alone
  int iterations = 12;       ///< at most, per level
  double epsilon_px = 0.04;  ///< px: a smaller step ends the iteration
  double min_eigenvalue =
      1.5;  ///< grey levels^2 per px: smaller eigenvalue of the mean gradient matrix; texture
  double max_forward_backward_px = 0.7;  ///< px: limit of the forward-backward error
  double max_residual = 25.0;            ///< grey levels: mean absolute difference of the two patches
};

/// Correspondences between two frames, ideal pixels. All arrays have the same length.
struct PointTracks {
  std::vector<cv::Point2f> previous;
  std::vector<cv::Point2f> current;
  int sampled = 0;  ///< grid points sampled, including those refused
};

/// Keeps the previous frame's pyramid. A change of the image size restarts the tracker.
class PointTracker {
 public:
  /// `unknown`: 255 where rectified images have no pixel (Rectifier::unknown()), or empty; patches that touch
  /// it are not tracked.
  explicit PointTracker(const TrackerParameters& parameters, const cv::Mat1b& unknown = {});
  ~PointTracker();

  /// Pyramid of an image, for advance(). Throws std::invalid_argument for an image that is empty or not 8-bit
  /// grey.
  Pyramid pyramidOf(const cv::Mat1b& grey) const;
  /// Tracks the grid of the previous image into this one, starting from `guess` (previous to current, ideal
  /// pixels). Empty for the first image and after a change of size. Without a guess tracking starts from the
  /// shift of the whole image, or from the neighbouring point's displacement.
  PointTracks advance(Pyramid image, const std::optional<Eigen::Matrix3d>& guess);
  PointTracks advance(const cv::Mat1b& grey, const std::optional<Eigen::Matrix3d>& guess) {
    return advance(pyramidOf(grey), guess);
  }
  /// True if at least `points` grid points of an image have enough texture to be tracked.
  bool hasTexture(const Pyramid& image, int points) const;
  void reset();
  /// In place of the constructor's, of the next images' and of the previous one's.
  void setUnknown(const cv::Mat1b& unknown);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
