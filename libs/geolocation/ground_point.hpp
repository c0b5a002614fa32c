// The point where the ray of a pixel meets level ground.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/geolocation/ground_view.hpp"
#include "redbee/geometry/camera_intrinsics.hpp"
#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// d(point) / d(what it was computed from), of the point's east and north [m]. A sign is that of what would
/// have to be added: J_attitude belongs to a left perturbation of R_EC.
struct GroundPoint {
  Eigen::Vector2d position;  ///< m, east and north in the local frame
  double range_m = 0;        ///< from the camera, along the ray
  double depression = 0;     ///< rad, of the ray below the horizon
  Eigen::Matrix<double, 2, 3> J_attitude;
  Eigen::Vector2d J_height;
  Eigen::Vector2d J_focal;  ///< relative change of the focal length
  Eigen::Matrix2d J_pixel;
};

/// std::nullopt for a pixel outside the field of view, and for a ray less than `min_depression` [rad, > 0]
/// below the horizon.
std::optional<GroundPoint> groundPointOf(const CameraModel& camera, const Eigen::Vector2d& pixel,
                                         const GroundView& view, double min_depression);

/// East and north of the ground points [m] of the image's corners, clockwise from the upper left;
/// std::nullopt unless each sees the ground.
std::optional<Eigen::Matrix<double, 2, 4>> footprintOf(const CameraIntrinsics& intrinsics,
                                                       const CameraModel& camera, const GroundView& view,
                                                       double min_depression);

}  // namespace redbee
