// Estimates a plane's homography from point correspondences with outliers: RANSAC, then refinement on the
// inliers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/visual/point_tracker.hpp"
#include "redbee/visual/ransac.hpp"

namespace redbee {

struct HomographyEstimate {
  Eigen::Matrix3d H;    ///< previous to current, ideal pixels, h33 = 1
  Matrix8d covariance;  ///< of the scaled entries, from the inliers' residuals (noise variance times inverse
                        ///< information)
  std::vector<uint8_t> inlier;  ///< per correspondence, 1 = follows the plane
  int inliers = 0;
  int outliers = 0;
  double rms_px = 0;  ///< of the inliers' transfer errors
};

/// The plane with most inliers; std::nullopt if no plane reaches the minima of the parameters. Least squares
/// on the inliers by Gauss-Newton.
std::optional<HomographyEstimate> estimateHomography(const PointTracks& tracks, int width, int height,
                                                     const RansacParameters& parameters);

/// The same among the tracks that are flagged with 1 in `chosen` (one flag per track).
std::optional<HomographyEstimate> estimateHomographyAmong(const PointTracks& tracks,
                                                          const std::vector<uint8_t>& chosen, int width,
                                                          int height, const RansacParameters& parameters);

/// The plane closest to a predicted one: candidates are the points that agree with `prediction` within its
/// uncertainty (scaled covariance) plus inlier_px; RANSAC selects the plane among them (libs/README.md,
/// "Visual homography"). Inlier flags refer to all tracks.
std::optional<HomographyEstimate> estimateHomographyNear(const PointTracks& tracks, int width, int height,
                                                         const Eigen::Matrix3d& prediction,
                                                         const Matrix8d& prediction_covariance,
                                                         const RansacParameters& parameters);

}  // namespace redbee
