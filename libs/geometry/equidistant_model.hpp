// Kalibr's equidistant model: Kannala-Brandt with four coefficients, OpenCV's cv::fisheye.
#pragma once

#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// With r = sqrt(X^2 + Y^2), a = atan2(r, Z), d(a) = a (1 + k1 a^2 + k2 a^4 + k3 a^6 + k4 a^8):
///   u = fx d X / r + cx,  v = fy d Y / r + cy
/// (J. Kannala, S. Brandt, "A generic camera model and calibration method for conventional, wide-angle, and
/// fish-eye lenses", 2006). Coefficients k1 k2 k3 k4. The domain ends where d stops growing with a; rays
/// behind the camera may lie inside. Images are rectified to a pinhole camera of at most 105 degrees.
class EquidistantModel : public CameraModel {
 public:
  explicit EquidistantModel(const CameraIntrinsics& intrinsics);

  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray,
                                         Eigen::Matrix<double, 2, 3>* J = nullptr) const override;
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const override;
  double fieldOfView() const override;
  CameraIntrinsics idealCamera() const override;
  bool isIdeal() const override { return false; }

 private:
  double distorted(double angle) const;  ///< d(a)
  double slope(double angle) const;      ///< d'(a)

  CameraIntrinsics intrinsics_;
  double k1_, k2_, k3_, k4_;
  double max_angle_;  ///< rad off the axis, where the domain ends
};

}  // namespace redbee
