// A plane's homography from point correspondences with outliers: RANSAC, then a fit refined on the inliers.
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

/// The plane with most inliers; nothing where no plane passes the minima. Least squares on the inliers by
/// Gauss-Newton.
std::optional<HomographyEstimate> estimateHomography(const PointTracks& tracks, int width, int height,
                                                     const RansacParameters& parameters);

/// The plane nearest to a predicted one: candidates are the points that agree with `prediction` within its
/// own uncertainty (scaled covariance) plus inlier_px; RANSAC selects the plane among them (libs/README.md,
/// "Visual homography"). Inlier flags refer to all tracks.
std::optional<HomographyEstimate> estimateHomographyNear(const PointTracks& tracks, int width, int height,
                                                         const Eigen::Matrix3d& prediction,
                                                         const Matrix8d& prediction_covariance,
                                                         const RansacParameters& parameters);

/// The front plane (libs/README.md): RANSAC over the points that the ground homography does not explain.
struct FrontPlaneParameters {
  double ground_px = 1.5;  ///< px: a point within this of the ground homography belongs to the ground
  RansacParameters ransac;
  double min_separation_px =
      0.5;  ///< px: a front plane whose motion differs less from the ground's, where its points are, is none
  FrontPlaneParameters();  ///< stricter minima of inlier ratio and spread than the ground's: the rest is
                           ///< mostly outliers
};
std::optional<HomographyEstimate> estimateFrontPlane(const PointTracks& tracks, const Eigen::Matrix3d& ground,
                                                     int width, int height,
                                                     const FrontPlaneParameters& parameters);

}  // namespace redbee
