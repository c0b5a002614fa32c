#include "redbee/geometry/equidistant_model.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/geometry/angle.hpp"

namespace redbee {
namespace {

/// Half the field of view of the ideal camera. A wider pinhole image mostly magnifies its border: at 52.5
/// degrees the border already has 2.7 times the centre's pixels per radian along the radius.
constexpr double kIdealHalfAngle = 52.5 * kDegree;
/// Sine of the angle to the axis below which the ray is taken as paraxial.
constexpr double kParaxial = 1e-9;

}  // namespace

EquidistantModel::EquidistantModel(const CameraIntrinsics& intrinsics)
    : intrinsics_(intrinsics),
      k1_(intrinsics.distortion.at(0)),
      k2_(intrinsics.distortion.at(1)),
      k3_(intrinsics.distortion.at(2)),
      k4_(intrinsics.distortion.at(3)),
      max_angle_(foldOver([this](double angle) { return slope(angle); }, kPi)) {}

double EquidistantModel::distorted(double angle) const {
  const double a2 = angle * angle;
  return angle * (1 + a2 * (k1_ + a2 * (k2_ + a2 * (k3_ + a2 * k4_))));
}

double EquidistantModel::slope(double angle) const {
  const double a2 = angle * angle;
  return 1 + a2 * (3 * k1_ + a2 * (5 * k2_ + a2 * (7 * k3_ + a2 * 9 * k4_)));
}

std::optional<Eigen::Vector2d> EquidistantModel::project(const Eigen::Vector3d& ray,
                                                         Eigen::Matrix<double, 2, 3>* J) const {
  const double r = ray.head<2>().norm(), z = ray.z(), squared = ray.squaredNorm();
  const double angle = std::atan2(r, z);
  if (!(squared > 0) || !(angle <= max_angle_)) return std::nullopt;
  double scale = 1 / z, scale_by_r = 0, scale_by_z = -1 / (z * z);  // of d / r, which is 1 / z on the axis
  if (r * r > kParaxial * kParaxial * squared) {
    const double d = distorted(angle), d_by_angle = slope(angle);
    scale = d / r;
    scale_by_r = (d_by_angle * z / squared - scale) / r;
    scale_by_z = -d_by_angle / squared;
  } else if (z < 0) {
    return std::nullopt;  // straight behind the camera the direction is undefined
  }
  const Eigen::Vector2d focal(intrinsics_.fx, intrinsics_.fy);
  if (J != nullptr) {
    const Eigen::Vector2d x = ray.head<2>();
    Eigen::Matrix<double, 2, 3> by_ray;
    by_ray.leftCols<2>() = scale * Eigen::Matrix2d::Identity();
    if (r > 0) by_ray.leftCols<2>() += (scale_by_r / r) * x * x.transpose();
    by_ray.col(2) = scale_by_z * x;
    *J = focal.asDiagonal() * by_ray;
  }
  return Eigen::Vector2d(focal.cwiseProduct(scale * ray.head<2>()) +
                         Eigen::Vector2d(intrinsics_.cx, intrinsics_.cy));
}

std::optional<Eigen::Vector3d> EquidistantModel::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d m((pixel.x() - intrinsics_.cx) / intrinsics_.fx,
                          (pixel.y() - intrinsics_.cy) / intrinsics_.fy);
  const double d = m.norm();
  if (!(d <= distorted(max_angle_))) return std::nullopt;
  if (d == 0) return Eigen::Vector3d::UnitZ();
  // Newton's method, safeguarded by bisection.
  double low = 0, high = max_angle_, angle = std::min(d, max_angle_);
  constexpr int kIterations = 60;
  for (int i = 0; i < kIterations; ++i) {
    const double error = distorted(angle) - d;
    (error > 0 ? high : low) = angle;
    if (std::abs(error) < 1e-15) break;
    const double next = angle - error / slope(angle);
    angle = next > low && next < high ? next : (low + high) / 2;
  }
  const double sine = std::sin(angle);
  return Eigen::Vector3d(sine * m.x() / d, sine * m.y() / d, std::cos(angle));
}

double EquidistantModel::fieldOfView() const { return 2 * max_angle_; }

CameraIntrinsics EquidistantModel::idealCamera() const {
  return coveringPinhole(*this, intrinsics_, kIdealHalfAngle);
}

}  // namespace redbee
