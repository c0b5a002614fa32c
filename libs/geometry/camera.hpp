// The camera: pinhole with radial-tangential distortion (Brown-Conrady; OpenCV's and Kalibr's "radtan").
#pragma once

#include <Eigen/Core>
#include <array>

namespace redbee {

/// Pixels have integer coordinates at their centres: the image spans [-0.5, width - 0.5].
struct CameraIntrinsics {
  int width = 0;   ///< px
  int height = 0;  ///< px
  double fx = 0;   ///< px
  double fy = 0;   ///< px
  double cx = 0;   ///< px
  double cy = 0;   ///< px
  /// k1, k2, p1, p2, k3 of the radial-tangential model; all zero for a camera without distortion.
  std::array<double, 5> distortion{};
};

/// "Raw" pixels are those of the image as recorded; "ideal" pixels are those that a camera with the same K
/// and no distortion would have recorded. Homographies hold between ideal pixels.
class Camera {
 public:
  explicit Camera(const CameraIntrinsics& intrinsics);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  const Eigen::Matrix3d& K() const { return K_; }
  const Eigen::Matrix3d& K_inverse() const { return K_inverse_; }
  bool isDistorted() const;

  /// Raw pixel of an ideal pixel.
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal) const;
  /// Ideal pixel of a raw pixel; Newton's method on the model, exact to 1e-9 px inside the image.
  Eigen::Vector2d undistort(const Eigen::Vector2d& raw) const;

 private:
  CameraIntrinsics intrinsics_;
  Eigen::Matrix3d K_;
  Eigen::Matrix3d K_inverse_;
};

}  // namespace redbee
