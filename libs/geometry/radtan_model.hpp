// Radial-tangential distortion: Brown-Conrady, ROS's plumb_bob, Kalibr's radtan.
#pragma once

#include <array>

#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// With x = X / Z, y = Y / Z, r^2 = x^2 + y^2, d = 1 + k1 r^2 + k2 r^4 + k3 r^6:
///   u = fx (x d + 2 p1 x y + p2 (r^2 + 2 x^2)) + cx,  v = fy (y d + p1 (r^2 + 2 y^2) + 2 p2 x y) + cy
/// (D. C. Brown, "Close-range camera calibration", 1971). Coefficients k1 k2 p1 p2 [k3]. The domain ends
/// where r d stops growing with r. Images are rectified to the same size and K.
class RadtanModel : public CameraModel {
 public:
  explicit RadtanModel(const CameraIntrinsics& intrinsics);

  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray,
                                         Eigen::Matrix<double, 2, 3>* J = nullptr) const override;
  /// By Newton's method, exact to 1e-9 px inside the image.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const override;
  double fieldOfView() const override;
  CameraIntrinsics idealCamera() const override;
  bool isIdeal() const override;

 private:
  CameraIntrinsics intrinsics_;
  std::array<double, 5> distortion_{};
  Eigen::Matrix3d K_;
  Eigen::Matrix3d K_inverse_;
  double max_radius_;  ///< of (x, y), where the domain ends
};

}  // namespace redbee
