// Where a box stands on the ground.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "redbee/geolocation/geolocator.hpp"
#include "redbee/geolocation/ground_point.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/camera.hpp"

namespace redbee {
namespace {

constexpr double kBorder_px = 1;
constexpr double kFlattest = 1e-3;  // rad below the horizon, whatever is configured

/// A square root A of a covariance: A A' = P.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> rootOf(const Eigen::Matrix<double, kSize, kSize>& P) {
  return Eigen::LLT<Eigen::Matrix<double, kSize, kSize>>(
             P + 1e-15 * Eigen::Matrix<double, kSize, kSize>::Identity())
      .matrixL();
}

double square(double x) { return x * x; }

}  // namespace

void Geolocator::setZoom(double zoom, double variance) {
  const CameraIntrinsics lens = zoomed(configured_, zoom);
  focal_sigma_ = std::sqrt(square(parameters_.focal_sigma) + variance);
  if (lens.fx != intrinsics_.fx) camera_ = makeCameraModel(intrinsics_ = lens);
}

bool Geolocator::isCutOff(const Eigen::Vector2d& foot) const {
  return foot.x() < kBorder_px || foot.y() < kBorder_px || foot.x() > intrinsics_.width - 1 - kBorder_px ||
         foot.y() > intrinsics_.height - 1 - kBorder_px;
}

std::optional<Eigen::Vector2d> Geolocator::project(const Eigen::Vector2d& position,
                                                   const GroundView& view) const {
  const Eigen::Vector2d offset = position - view.position;
  return camera_->project(view.R_EC.transpose() * Eigen::Vector3d(offset.x(), offset.y(), -view.height_m));
}

/// The foot's point on the ground. Of a known target, to first order about the pixel where it is expected: a
/// derivative that was taken at the measured pixel would depend on that pixel's error, and as large errors
/// that last are multiplied by it, the filter's gain would, too.
std::optional<GroundPoint> Geolocator::pointOf(const Eigen::Vector2d& foot, const GroundView& view,
                                               const std::optional<Eigen::Vector2d>& predicted) const {
  const double flattest = std::max(kFlattest, parameters_.min_depression_deg * kDegree);
  auto measured = groundPointOf(*camera_, foot, view, flattest);
  if (!measured || !predicted) return measured;
  const auto expected_pixel = project(*predicted, view);
  auto expected = expected_pixel ? groundPointOf(*camera_, *expected_pixel, view, flattest) : std::nullopt;
  if (!expected) return measured;
  expected->position += expected->J_pixel * (foot - *expected_pixel);
  return expected;
}

std::optional<Geolocator::Placed> Geolocator::place(const ImageBox& box, const GroundView& view,
                                                    const std::optional<Eigen::Vector2d>& predicted) {
  const Eigen::Vector3d down = -view.R_EC.row(2).transpose();
  const auto foot = footOf(box, *camera_, down, parameters_.height_over_length);
  const auto point = foot ? pointOf(foot->pixel, view, predicted) : std::nullopt;
  if (!point) {
    ++refused_.above_horizon;
    return std::nullopt;
  }
  const Eigen::Vector2d edge = box.centre() + (foot->pixel - box.centre()).normalized() * foot->along_px / 2;
  if (isCutOff(edge)) {
    ++refused_.cut_off;
    return std::nullopt;
  }
  Placed placed;
  placed.range_m = point->range_m;
  const double metres_per_px = point->range_m / std::sqrt(intrinsics_.fx * intrinsics_.fy);
  placed.size = Eigen::Vector2d(foot->across_px, foot->along_px) * metres_per_px;
  GroundMeasurement& m = placed.measurement;
  m.z = point->position;
  m.R = square(parameters_.pixel_sigma_px) * point->J_pixel * point->J_pixel.transpose();
  const Eigen::Matrix3d attitude =
      view.attitude_covariance + square(parameters_.mount_sigma_deg * kDegree) * Eigen::Matrix3d::Identity();
  const double slope_m =
      point->range_m * std::cos(point->depression) * std::tan(parameters_.ground_slope_sigma_deg * kDegree);
  m.G << point->J_attitude * rootOf<3>(attitude), rootOf<2>(view.position_covariance),
      point->J_height * std::hypot(view.height_sigma_m, slope_m), point->J_focal * focal_sigma_,
      point->J_pixel * parameters_.foot_sigma * foot->along_px;
  return placed;
}

}  // namespace redbee
