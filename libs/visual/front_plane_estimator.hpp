// Estimates the front plane (libs/README.md): a plane in front of the ground, such as a wall.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/point_tracker.hpp"
#include "redbee/visual/ransac.hpp"

namespace redbee {

struct FrontPlaneParameters {
  double ground_px = 1.5;  ///< px: a point within this of the ground homography belongs to the ground
  RansacParameters ransac;
  double min_separation_px =
      0.5;  ///< px: minimum mean distance between the front plane's and the ground's motion at its points
  FrontPlaneParameters();  ///< higher minima of inlier ratio and spread than for the ground, as most
                           ///< remaining points are outliers
};

class FrontPlaneEstimator {
 public:
  /// `width`, `height`: of the image [px].
  FrontPlaneEstimator(int width, int height, const FrontPlaneParameters& parameters)
      : width_(width), height_(height), parameters_(parameters) {}

  /// By RANSAC over the tracks that the ground's homography (previous to current, ideal pixels) does not
  /// explain. std::nullopt if there is no such plane.
  std::optional<HomographyEstimate> estimate(const PointTracks& tracks, const Eigen::Matrix3d& ground) const;

 private:
  int width_;
  int height_;
  FrontPlaneParameters parameters_;
};

}  // namespace redbee
