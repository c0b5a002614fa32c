// Estimates the ground homography from points of which many may lie on other surfaces: facades, bushes,
// people.
//
// A homography fitted to its own inliers is biased towards surfaces close to the ground, which move
// similarly. Therefore the points are first fitted with a prior that constrains the camera's rotation and the
// vertical, and weakly the translation:
//
//     min  sum_i rho(x_b - H(h) x_a) + (h - h_0)' P^-1 (h - h_0)      P = J_R J_R' s_R^2 + J_t J_t' s_t^2 +
//     J_m J_m' s_m^2
//
// with rho after Geman and McClure, its scale shrinking (graduated non-convexity). The inliers of that fit
// are ground points; the measured homography is fitted to them without the prior.
#pragma once

#include <optional>

#include "redbee/calibration/joint_problem.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee::calibration {

struct GroundPrediction {
  PlaneMotion motion;
  double rotation_sigma_rad = 0.0005;
  double translation_sigma = 0.005;  ///< heights
  double normal_sigma_rad = 0.01;
};

/// Frame indices are not set. std::nullopt if too few points lie on the predicted plane or they do not spread
/// over the image.
std::optional<GroundHomography> fitGround(const PointTracks& points, const CameraIntrinsics& ideal,
                                          const GroundPrediction& prediction);

}  // namespace redbee::calibration
