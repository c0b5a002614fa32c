#include "redbee/geometry/radtan_model.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace redbee {
namespace {

/// Slope of the steepest ray that is checked, 89 degrees off the axis; a model that is injective up to there
/// is taken to be so beyond.
constexpr double kSteepestSlope = 57.29;

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

double maxRadius(const std::array<double, 5>& d) {
  // In steps of the angle, which are fine near the axis, where distortion polynomials fold over.
  const auto slope = [&d](double angle) {
    const double t = std::tan(angle), r2 = t * t;
    return 1.0 + r2 * (3.0 * d[0] + r2 * (5.0 * d[1] + r2 * 7.0 * d[4]));
  };
  const double steepest = std::atan(kSteepestSlope);
  const double angle = foldOver(slope, steepest);
  return angle < steepest ? std::tan(angle) : std::numeric_limits<double>::infinity();
}

}  // namespace

RadtanModel::RadtanModel(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
  std::copy(intrinsics.distortion.begin(), intrinsics.distortion.end(), distortion_.begin());
  K_ << intrinsics.fx, 0, intrinsics.cx, 0, intrinsics.fy, intrinsics.cy, 0, 0, 1;
  K_inverse_ = K_.inverse();
  max_radius_ = maxRadius(distortion_);
}

std::optional<Eigen::Vector2d> RadtanModel::project(const Eigen::Vector3d& ray,
                                                    Eigen::Matrix<double, 2, 3>* J) const {
  if (!(ray.z() > 0)) return std::nullopt;
  const Eigen::Vector2d x = ray.hnormalized();
  if (!(x.norm() <= max_radius_)) return std::nullopt;
  Eigen::Matrix2d by_slopes;
  const Eigen::Vector2d distorted = applyDistortion(distortion_, x, J != nullptr ? &by_slopes : nullptr);
  if (J != nullptr) {
    Eigen::Matrix<double, 2, 3> slopes_by_ray;
    slopes_by_ray << 1 / ray.z(), 0, -x.x() / ray.z(), 0, 1 / ray.z(), -x.y() / ray.z();
    *J = K_.topLeftCorner<2, 2>() * by_slopes * slopes_by_ray;
  }
  return (K_ * distorted.homogeneous()).head<2>();
}

std::optional<Eigen::Vector3d> RadtanModel::unproject(const Eigen::Vector2d& pixel) const {
  constexpr int kIterations = 20;
  constexpr double kSettled = 1e-24, kAccepted = 1e-18;
  const Eigen::Vector2d target = (K_inverse_ * pixel.homogeneous()).head<2>();
  Eigen::Vector2d x = target;
  Eigen::Matrix2d J;
  double squared_error = 0;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Vector2d error = applyDistortion(distortion_, x, &J) - target;
    x -= J.inverse() * error;
    squared_error = error.squaredNorm();
    if (squared_error < kSettled) break;
  }
  if (!(squared_error < kAccepted) || !(x.norm() <= max_radius_)) return std::nullopt;
  return x.homogeneous();
}

double RadtanModel::fieldOfView() const { return 2 * std::atan(max_radius_); }

CameraIntrinsics RadtanModel::idealCamera() const {
  CameraIntrinsics ideal = intrinsics_;
  ideal.distortion.assign(ideal.distortion.size(), 0.0);
  return ideal;
}

bool RadtanModel::isIdeal() const {
  return std::all_of(distortion_.begin(), distortion_.end(), [](double k) { return k == 0; });
}

}  // namespace redbee
