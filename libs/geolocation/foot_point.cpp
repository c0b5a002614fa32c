#include "redbee/geolocation/foot_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace redbee {
namespace {

/// Length of the box along a unit direction, through its centre.
double extentAlong(const ImageBox& box, const Eigen::Vector2d& direction) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double x = std::abs(direction.x()) > 0 ? box.width / std::abs(direction.x()) : kNone;
  const double y = std::abs(direction.y()) > 0 ? box.height / std::abs(direction.y()) : kNone;
  return std::min(x, y);
}

}  // namespace

std::optional<FootPoint> footOf(const ImageBox& box, const CameraModel& camera, const Eigen::Vector3d& down,
                                double height_over_length) {
  const auto ray = camera.unproject(box.centre());
  if (!ray) return std::nullopt;
  const Eigen::Vector3d unit = ray->normalized();
  Eigen::Matrix<double, 2, 3> J;
  if (!camera.project(unit, &J)) return std::nullopt;
  const Eigen::Vector2d plumb = J * down;
  const double sine = std::min(1.0, std::max(0.0, unit.dot(down)));
  const double cosine = std::sqrt(1 - sine * sine);
  const double inwards = sine > 0 ? 0.5 * sine / (sine + height_over_length * cosine) : 0;
  // Straight below the camera a plumb line is a point: any direction will do.
  const double norm = plumb.norm();
  const Eigen::Vector2d direction =
      norm > std::numeric_limits<double>::min() ? Eigen::Vector2d(plumb / norm) : Eigen::Vector2d::UnitY();
  FootPoint foot;
  foot.along_px = extentAlong(box, direction);
  foot.across_px = extentAlong(box, {-direction.y(), direction.x()});
  foot.pixel = box.centre() + direction * foot.along_px * (0.5 - inwards);
  return foot;
}

}  // namespace redbee
