// A camera as the stages use it: raw pixels, and the ideal pixels that homographies hold between.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "redbee/geometry/camera_intrinsics.hpp"
#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// "Raw" pixels are those of the image as recorded; "ideal" pixels are those of the pinhole camera without
/// distortion that the camera model chooses at the same place: the same size and K for a radial-tangential
/// lens, its own for a wide one. Homographies hold between ideal pixels.
class Camera {
 public:
  /// Throws std::invalid_argument as makeCameraModel() does.
  explicit Camera(const CameraIntrinsics& intrinsics);
  /// With another ideal camera than the model chooses; the same pixels where the model needs no
  /// rectification.
  Camera(const CameraIntrinsics& intrinsics, const CameraIntrinsics& ideal);

  /// Of the raw image.
  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  /// Of the ideal image, without distortion.
  const CameraIntrinsics& ideal() const { return ideal_; }
  const CameraModel& model() const { return *model_; }
  /// Of the ideal camera.
  const Eigen::Matrix3d& K() const { return K_; }
  const Eigen::Matrix3d& K_inverse() const { return K_inverse_; }
  /// False where raw and ideal pixels are the same.
  bool isDistorted() const { return !model_->isIdeal(); }

  /// Raw pixel of an ideal pixel; nothing outside the model's domain.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& ideal) const;
  /// Ideal pixel of a raw pixel; nothing outside the model's domain, or where the ray does not point ahead.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& raw) const;

 private:
  CameraIntrinsics intrinsics_;
  std::shared_ptr<const CameraModel> model_;
  CameraIntrinsics ideal_;
  Eigen::Matrix3d K_;
  Eigen::Matrix3d K_inverse_;
};

/// The ideal camera of the raw one: the size and K of what leaves the rectifier.
CameraIntrinsics idealCamera(const CameraIntrinsics& raw);

}  // namespace redbee
