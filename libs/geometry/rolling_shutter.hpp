// A camera with a rolling shutter: each row of an image has a time of its own. Raw pixels are moved to where
// a camera that exposes all rows at the middle row's time would see them, and back (libs/README.md, "Rolling
// shutter").
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "redbee/geometry/camera.hpp"

namespace redbee {

/// Motion of the camera while one image is read out, in the camera's frame C at the middle row's time.
struct RowMotion {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();          ///< rad/s, at the middle row
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< rad/s^2
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< 1/s, over the height above the ground
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();       ///< unit, towards the ground

  /// Turns coordinates in C into those of the camera `tau_s` later.
  Eigen::Matrix3d rotationAfter(double tau_s) const;
  /// Direction in which the camera sees, `tau_s` later, what lies at `ray` (z > 0) in C: on the ground, above
  /// its horizon at infinity.
  Eigen::Vector3d later(const Eigen::Vector3d& ray, double tau_s) const;
  /// The inverse of later().
  Eigen::Vector3d earlier(const Eigen::Vector3d& ray, double tau_s) const;

  bool operator==(const RowMotion& other) const {
    return rate == other.rate && acceleration == other.acceleration && velocity == other.velocity &&
           normal == other.normal;
  }
};

/// s, of a raw row's exposure after the image's time.
inline double rowTime(const CameraIntrinsics& camera, double row) {
  return (row - 0.5 * (camera.height - 1)) * camera.line_delay_s;
}
/// s, from the image's time to the exposure of its last row.
inline double halfReadout(const CameraIntrinsics& camera) {
  return std::abs(rowTime(camera, camera.height - 1));
}

/// Raw pixel of an ideal one; std::nullopt outside of the model's domain.
std::optional<Eigen::Vector2d> rawPixel(const Camera& camera, const Eigen::Vector2d& ideal,
                                        const RowMotion& motion);
/// Ideal pixel of a raw one: where it would be at the middle row's time.
std::optional<Eigen::Vector2d> idealPixel(const Camera& camera, const Eigen::Vector2d& raw,
                                          const RowMotion& motion);

}  // namespace redbee
