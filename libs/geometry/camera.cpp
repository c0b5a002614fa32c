#include "redbee/geometry/camera.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace redbee {

Camera::Camera(const CameraIntrinsics& intrinsics) : Camera(intrinsics, idealCamera(intrinsics)) {}

Camera::Camera(const CameraIntrinsics& intrinsics, const CameraIntrinsics& ideal)
    : intrinsics_(intrinsics), model_(makeCameraModel(intrinsics)), ideal_(ideal) {
  K_ << ideal_.fx, 0, ideal_.cx, 0, ideal_.fy, ideal_.cy, 0, 0, 1;
  K_inverse_ = K_.inverse();
}

std::optional<Eigen::Vector2d> Camera::distort(const Eigen::Vector2d& ideal) const {
  const Eigen::Vector2d x = (K_inverse_ * ideal.homogeneous()).head<2>();
  return model_->project(x.homogeneous());
}

std::optional<Eigen::Vector2d> Camera::undistort(const Eigen::Vector2d& raw) const {
  const auto ray = model_->unproject(raw);
  if (!ray || !(ray->z() > 0)) return std::nullopt;
  return (K_ * ray->hnormalized().homogeneous()).head<2>();
}

CameraIntrinsics zoomed(CameraIntrinsics camera, double zoom) {
  camera.fx *= zoom;
  camera.fy *= zoom;
  return camera;
}

Camera zoomed(const Camera& camera, double zoom) {
  return zoom == 1 ? camera : Camera(zoomed(camera.intrinsics(), zoom), zoomed(camera.ideal(), zoom));
}

Eigen::Matrix3d zoomed(Eigen::Matrix3d K, double zoom) {
  K(0, 0) *= zoom;
  K(1, 1) *= zoom;
  return K;
}

CameraIntrinsics idealCamera(const CameraIntrinsics& raw) { return makeCameraModel(raw)->idealCamera(); }

}  // namespace redbee
