// A camera with its lens model: raw pixels of the recorded image, and ideal (undistorted) pixels, between
// which homographies hold.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "redbee/geometry/camera_intrinsics.hpp"
#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// "Raw" pixels are those of the recorded image. "Ideal" pixels are those of a pinhole camera without
/// distortion at the same pose: of the same size and K for a radial-tangential lens, of a size and K chosen
/// by the camera model for a wide-angle lens.
class Camera {
 public:
  /// Throws std::invalid_argument as makeCameraModel() does.
  explicit Camera(const CameraIntrinsics& intrinsics);
  /// Uses this ideal camera instead of the model's. If the model needs no rectification, raw and ideal pixels
  /// are the same.
  Camera(const CameraIntrinsics& intrinsics, const CameraIntrinsics& ideal);

  /// Intrinsics of the raw image.
  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  /// Intrinsics of the ideal image; no distortion.
  const CameraIntrinsics& ideal() const { return ideal_; }
  const CameraModel& model() const { return *model_; }
  /// Camera matrix of the ideal camera.
  const Eigen::Matrix3d& K() const { return K_; }
  const Eigen::Matrix3d& K_inverse() const { return K_inverse_; }
  /// False if raw and ideal pixels are the same.
  bool isDistorted() const { return !model_->isIdeal(); }

  /// Raw pixel of an ideal pixel; std::nullopt outside the model's domain.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& ideal) const;
  /// Ideal pixel of a raw pixel; std::nullopt outside the model's domain or if the ray does not point
  /// forward.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& raw) const;

 private:
  CameraIntrinsics intrinsics_;
  std::shared_ptr<const CameraModel> model_;
  CameraIntrinsics ideal_;
  Eigen::Matrix3d K_;
  Eigen::Matrix3d K_inverse_;
};

/// With focal lengths `zoom` times as long, about the same principal point and with the same distortion of
/// rays; as it is for 1. `zoom` > 0.
CameraIntrinsics zoomed(CameraIntrinsics camera, double zoom);
/// Raw and ideal camera alike.
Camera zoomed(const Camera& camera, double zoom);
Eigen::Matrix3d zoomed(Eigen::Matrix3d K, double zoom);

/// Intrinsics of the images that the rectifier produces from this raw camera's.
CameraIntrinsics idealCamera(const CameraIntrinsics& raw);

}  // namespace redbee
