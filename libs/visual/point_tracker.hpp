// Points on a regular grid, followed from frame to frame by pyramidal Lucas-Kanade.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/imaging/pyramid.hpp"

namespace redbee {

struct TrackerParameters {
  int grid_px =
      24;  ///< px between sample points, both ways (paper: 16); half of it in an image of little texture
  int window_px = 13;        ///< px, odd: side of the patch that is followed
  int levels = 3;            ///< pyramid levels, 1 = the image alone
  int iterations = 12;       ///< at most, per level
  double epsilon_px = 0.04;  ///< px: a smaller step ends the iteration
  double min_eigenvalue =
      1.5;  ///< grey levels^2 per px: smaller eigenvalue of the mean gradient matrix; texture
  double max_forward_backward_px = 0.7;  ///< px: a point tracked there and back must return this close
  double max_residual = 25.0;            ///< grey levels: mean absolute difference of the two patches
};

/// Correspondences between two frames, ideal pixels. All arrays have the same length.
struct PointTracks {
  std::vector<cv::Point2f> previous;
  std::vector<cv::Point2f> current;
  int sampled = 0;  ///< grid points tried, the refused ones included
};

/// Keeps the previous frame's pyramid. Assumes grey 8-bit images of one size; a change of size restarts it.
class PointTracker {
 public:
  /// `unseen`: 255 where the images show nothing (rectifier.hpp), empty if they are whole; patches that touch
  /// it are not tracked.
  explicit PointTracker(const TrackerParameters& parameters, const cv::Mat& unseen = {});
  ~PointTracker();

  /// An image as advance() takes it. Throws std::invalid_argument for one that is empty or not 8-bit grey.
  Pyramid pyramidOf(const cv::Mat& grey) const;
  /// Tracks the grid of the previous image into this one, `guess` (previous to current, ideal pixels) as the
  /// starting point. Empty on the first image and after a change of size. Without a guess the starting point
  /// is the shift of the image as a whole, or the neighbouring point's displacement.
  PointTracks advance(Pyramid image, const std::optional<Eigen::Matrix3d>& guess);
  PointTracks advance(const cv::Mat& grey, const std::optional<Eigen::Matrix3d>& guess) {
    return advance(pyramidOf(grey), guess);
  }
  /// True if at least `points` grid points of an image have enough texture to be tracked.
  bool hasTexture(const Pyramid& image, int points) const;
  void reset();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
