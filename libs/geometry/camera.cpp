#include "redbee/geometry/camera.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace redbee {
namespace {

Eigen::Vector2d applyDistortion(const std::array<double, 5>& d, const Eigen::Vector2d& x,
                                Eigen::Matrix2d* J) {
  const auto [k1, k2, p1, p2, k3] = d;
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double xy = x.x() * x.y();
  if (J != nullptr) {
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / d(r2), times 2
    (*J)(0, 0) = radial + slope * x.x() * x.x() + 2.0 * p1 * x.y() + 6.0 * p2 * x.x();
    (*J)(0, 1) = slope * xy + 2.0 * p1 * x.x() + 2.0 * p2 * x.y();
    (*J)(1, 0) = (*J)(0, 1);
    (*J)(1, 1) = radial + slope * x.y() * x.y() + 6.0 * p1 * x.y() + 2.0 * p2 * x.x();
  }
  return {x.x() * radial + 2.0 * p1 * xy + p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * p2 * xy};
}

}  // namespace

Camera::Camera(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
  K_ << intrinsics.fx, 0, intrinsics.cx, 0, intrinsics.fy, intrinsics.cy, 0, 0, 1;
  K_inverse_ = K_.inverse();
}

bool Camera::isDistorted() const {
  return std::any_of(intrinsics_.distortion.begin(), intrinsics_.distortion.end(),
                     [](double k) { return k != 0; });
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& ideal) const {
  const Eigen::Vector2d x = (K_inverse_ * ideal.homogeneous()).head<2>();
  return (K_ * applyDistortion(intrinsics_.distortion, x, nullptr).homogeneous()).head<2>();
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& raw) const {
  const Eigen::Vector2d target = (K_inverse_ * raw.homogeneous()).head<2>();
  Eigen::Vector2d x = target;
  Eigen::Matrix2d J;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d error = applyDistortion(intrinsics_.distortion, x, &J) - target;
    x -= J.inverse() * error;
    if (error.squaredNorm() < 1e-24) break;
  }
  return (K_ * x.homogeneous()).head<2>();
}

}  // namespace redbee
