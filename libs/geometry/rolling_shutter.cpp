#include "redbee/geometry/rolling_shutter.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "redbee/geometry/so3.hpp"

namespace redbee {

Eigen::Matrix3d RowMotion::rotationAfter(double tau_s) const {
  return expSO3(-(rate * tau_s + 0.5 * tau_s * tau_s * acceleration));
}

Eigen::Vector3d RowMotion::later(const Eigen::Vector3d& ray, double tau_s) const {
  return rotationAfter(tau_s) * (ray - tau_s * std::max(0.0, normal.dot(ray)) * velocity);
}

Eigen::Vector3d RowMotion::earlier(const Eigen::Vector3d& ray, double tau_s) const {
  const Eigen::Vector3d turned = rotationAfter(tau_s).transpose() * ray;
  const double towards_ground = std::max(0.0, normal.dot(turned)) / (1 - tau_s * normal.dot(velocity));
  return turned + tau_s * towards_ground * velocity;
}

std::optional<Eigen::Vector2d> rawPixel(const Camera& camera, const Eigen::Vector2d& ideal,
                                        const RowMotion& motion) {
  // A row's time depends on the row: each step leaves a few hundredths of the error, the image's motion from
  // one row's exposure to the next's.
  constexpr int kSteps = 3;
  const Eigen::Vector3d ray = camera.K_inverse() * ideal.homogeneous();
  std::optional<Eigen::Vector2d> raw = camera.model().project(ray);
  for (int i = 0; raw && i < kSteps; ++i) {
    raw = camera.model().project(motion.later(ray, rowTime(camera.intrinsics(), raw->y())));
  }
  return raw;
}

std::optional<Eigen::Vector2d> idealPixel(const Camera& camera, const Eigen::Vector2d& raw,
                                          const RowMotion& motion) {
  const auto ray = camera.model().unproject(raw);
  if (!ray || !(ray->z() > 0)) return std::nullopt;
  const Eigen::Vector3d moved = motion.earlier(*ray, rowTime(camera.intrinsics(), raw.y()));
  if (!(moved.z() > 0)) return std::nullopt;
  return (camera.K() * moved).hnormalized();
}

}  // namespace redbee
