#include "redbee/geolocation/ground_point.hpp"

#include <cmath>

#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

/// d(east, north) / d(ray) of c + ray * (height / -ray_z).
Eigen::Matrix<double, 2, 3> intersectionJacobian(const Eigen::Vector3d& ray, double height_m) {
  const double scale = height_m / -ray.z();
  Eigen::Matrix<double, 2, 3> J;
  J << scale, 0, scale * ray.x() / -ray.z(), 0, scale, scale * ray.y() / -ray.z();
  return J;
}

/// d(unit ray in C) / d(pixel), from the model's inverse; std::nullopt at the border of its domain.
std::optional<Eigen::Matrix<double, 3, 2>> rayJacobian(const CameraModel& camera,
                                                       const Eigen::Vector2d& pixel) {
  constexpr double kStep_px = 0.25;
  Eigen::Matrix<double, 3, 2> J;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(axis);
    const auto low = camera.unproject(pixel - step);
    const auto high = camera.unproject(pixel + step);
    if (!low || !high) return std::nullopt;
    J.col(axis) = (high->normalized() - low->normalized()) / (2 * kStep_px);
  }
  return J;
}

}  // namespace

std::optional<GroundPoint> groundPointOf(const CameraModel& camera, const Eigen::Vector2d& pixel,
                                         const GroundView& view, double min_depression) {
  const auto unprojected = camera.unproject(pixel);
  if (!unprojected) return std::nullopt;
  const Eigen::Vector3d in_camera = unprojected->normalized();
  const Eigen::Vector3d ray = view.R_EC * in_camera;
  GroundPoint point;
  point.depression = std::asin(std::min(1.0, std::max(-1.0, -ray.z())));
  if (!(point.depression >= min_depression) || !(view.height_m > 0)) return std::nullopt;
  const auto J_ray = rayJacobian(camera, pixel);
  if (!J_ray) return std::nullopt;
  point.range_m = view.height_m / -ray.z();
  point.position = view.position + point.range_m * ray.head<2>();
  const Eigen::Matrix<double, 2, 3> J = intersectionJacobian(ray, view.height_m);
  point.J_attitude = -J * skew(ray);
  point.J_height = ray.head<2>() / -ray.z();
  // A longer focal length: the same pixel lies closer to the axis.
  point.J_focal = J * view.R_EC * Eigen::Vector3d(-in_camera.x(), -in_camera.y(), 0);
  point.J_pixel = J * view.R_EC * *J_ray;
  return point;
}

std::optional<Eigen::Matrix<double, 2, 4>> footprintOf(const CameraIntrinsics& intrinsics,
                                                       const CameraModel& camera, const GroundView& view,
                                                       double min_depression) {
  const double right = intrinsics.width - 1, bottom = intrinsics.height - 1;
  const Eigen::Vector2d corners[] = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  Eigen::Matrix<double, 2, 4> footprint;
  for (int i = 0; i < 4; ++i) {
    const auto point = groundPointOf(camera, corners[i], view, min_depression);
    if (!point) return std::nullopt;
    footprint.col(i) = point->position;
  }
  return footprint;
}

}  // namespace redbee
