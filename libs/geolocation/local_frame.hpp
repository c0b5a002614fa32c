// Metres east and north on the ground, and their places on WGS-84.
#pragma once

#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>
#include <optional>

#include "redbee/geolocation/vehicle_pose.hpp"

namespace redbee {

/// The origin is the place of take-off where the autopilot's estimator has one (VehiclePose::local),
/// otherwise the first position that was known. Once it has a place on WGS-84 it keeps it: without a fix,
/// positions go on by the estimator's.
class LocalFrame {
 public:
  struct Place {
    Eigen::Vector2d position;    ///< m, of the camera
    Eigen::Matrix2d covariance;  ///< m^2
    double convergence = 0;      ///< rad, from the frame's north to the place's, anticlockwise
  };
  /// std::nullopt where the pose has no position that can be compared with the others.
  std::optional<Place> placeOf(const VehiclePose& pose);

  bool isGlobal() const { return origin_.has_value(); }
  /// Of a point on the ground [m]. Precondition: isGlobal().
  Geodetic geodeticOf(const Eigen::Vector2d& position) const;
  /// The other way round [m]. Precondition: isGlobal().
  Eigen::Vector2d positionOf(const Geodetic& place) const;
  /// Whether the last placeOf() began another frame: earlier positions mean nothing in it. Once.
  bool takeRestart();

 private:
  void anchor(const Geodetic& at, const Eigen::Vector2d& position);
  Place globalPlace(const VehiclePose& pose);

  std::optional<GeographicLib::LocalCartesian> origin_;
  std::optional<Eigen::Vector2d> from_local_;             ///< m, from the estimator's frame to this one
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();  ///< of the last fix
  ImuTime fix_time_;
  bool has_begun_ = false;
  bool has_restarted_ = false;
};

}  // namespace redbee
