#include "processes/serve/map_view.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

constexpr double kWgs84Axis_m = 6378137;
constexpr double kWgs84Eccentricity2 = 6.69437999014e-3;
constexpr int64_t kStale_us = 1'000'000;
constexpr size_t kLongestPath = 2000;
constexpr double kPathStep_m = 0.5;
constexpr double kShallowest_rad = 5 * M_PI / 180;

Eigen::Matrix3d attitudeOf(const pose_t& pose) {
  return Eigen::Quaterniond(pose.quat[0], pose.quat[1], pose.quat[2], pose.quat[3])
      .normalized()
      .toRotationMatrix();
}

/// East and north [m] of a latitude and longitude from another, by the ellipsoid's radii of curvature there:
/// to the centimetre over a kilometre.
Eigen::Vector2d metresFrom(const Eigen::Vector2d& origin_deg, const Eigen::Vector2d& degrees) {
  const double latitude = origin_deg.x() * M_PI / 180;
  const double w = 1 - kWgs84Eccentricity2 * std::sin(latitude) * std::sin(latitude);
  const double across = kWgs84Axis_m / std::sqrt(w);
  const double along = across * (1 - kWgs84Eccentricity2) / w;
  const Eigen::Vector2d moved =
      Eigen::Vector2d(degrees.x() - origin_deg.x(), std::remainder(degrees.y() - origin_deg.y(), 360)) *
      M_PI / 180;
  return {moved.y() * across * std::cos(latitude), moved.x() * along};
}

}  // namespace

std::vector<Eigen::Vector2d> footprintOf(const Camera& camera, const Eigen::Matrix3d& R_GC, double height_m) {
  const double right = camera.intrinsics().width - 1.0;
  const double bottom = camera.intrinsics().height - 1.0;
  std::vector<Eigen::Vector2d> corners;
  bool meets_ground = false;
  for (const Eigen::Vector2d& raw : {Eigen::Vector2d(0, 0), {right, 0}, {right, bottom}, {0, bottom}}) {
    const auto ideal = camera.undistort(raw);
    if (!ideal) return {};
    const Eigen::Vector3d ray = (R_GC * camera.K_inverse() * ideal->homogeneous()).normalized();
    const double depression = std::asin(std::clamp(-ray.z(), -1.0, 1.0));
    meets_ground = meets_ground || depression > kShallowest_rad;
    const double reach = height_m / std::tan(std::max(depression, kShallowest_rad));
    const Eigen::Vector2d level = ray.head<2>();
    corners.push_back(level.norm() > 0 ? Eigen::Vector2d(level.normalized() * reach)
                                       : Eigen::Vector2d::Zero());
  }
  return meets_ground ? corners : std::vector<Eigen::Vector2d>{};
}

MapBuilder::MapBuilder(const Configuration& configuration)
    : camera_(configuration.camera),
      R_IC_(configuration.inertial.extrinsics.R_CI.transpose()),
      timeshift_us_(std::llround(configuration.inertial.extrinsics.timeshift_s * 1e6)) {}

std::optional<Eigen::Vector2d> MapBuilder::positionOf(const pose_t& pose) {
  if (pose.has_local != 0) {
    if (!is_local_) path_.clear();  // from another origin
    is_local_ = true;
    return Eigen::Vector2d(pose.local[0], pose.local[1]);
  }
  if (pose.has_global == 0 || is_local_) return std::nullopt;
  const Eigen::Vector2d degrees(pose.latitude, pose.longitude);
  if (!origin_deg_) origin_deg_ = degrees;
  return metresFrom(*origin_deg_, degrees);
}

void MapBuilder::onPose(const pose_t& pose) {
  pose_ = pose;
  position_ = positionOf(pose);
  if (!position_ || (!path_.empty() && (path_.back() - *position_).norm() < kPathStep_m)) return;
  path_.push_back(*position_);
  if (path_.size() > kLongestPath) path_.pop_front();
}

void MapBuilder::onFused(const fused_homography_t& fused) {
  if (fused.has_motion == 0) return;
  height_utime_ = fused.utime;
  height_m_ = fused.motion.distance;
}

std::optional<double> MapBuilder::heightAt(int64_t utime) const {
  if (height_m_ > 0 && std::abs(utime - height_utime_) < kStale_us) return height_m_;
  if (pose_ && pose_->has_home_altitude != 0 && pose_->home_altitude > 0) return pose_->home_altitude;
  return std::nullopt;
}

MapView MapBuilder::view(int64_t utime) const {
  MapView view;
  view.path.assign(path_.begin(), path_.end());
  if (!pose_) {
    view.note = "no POSE: the position comes from redbee-autopilot, which needs autopilot.link";
    return view;
  }
  if (const int64_t age = utime + timeshift_us_ - pose_->utime; age > kStale_us) {
    view.note = fmt::format("POSE is {:.1f} s old: what is drawn is where the drone was",
                            static_cast<double>(age) / 1e6);
  } else if (age < -kStale_us) {
    view.note = fmt::format("POSE is {:.1f} s ahead of the camera: their clocks differ",
                            -static_cast<double>(age) / 1e6);
  }
  if (!position_) {
    view.note = "POSE has no position: the autopilot has neither a fix nor a local position";
    return view;
  }
  const Eigen::Matrix3d R_GI = attitudeOf(*pose_);
  view.own = MapView::Own{*position_, std::atan2(R_GI(0, 0), R_GI(1, 0)), heightAt(utime)};
  if (view.own->height_m) {
    for (const Eigen::Vector2d& corner : footprintOf(camera_, R_GI * R_IC_, *view.own->height_m))
      view.footprint.push_back(corner + *position_);
    if (view.footprint.empty() && view.note.empty())
      view.note = "the camera looks above the horizon: no footprint";
  } else if (view.note.empty()) {
    view.note = "no height above the ground: no footprint";
  }
  return view;
}

}  // namespace redbee
