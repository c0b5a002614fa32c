#include "processes/serve/map_view.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "processes/geolocation/target_messages.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

constexpr int64_t kStale_us = 1'000'000;
constexpr size_t kLongestPath = 2000;
constexpr double kPathStep_m = 0.5;
constexpr double kShallowest_rad = 5 * M_PI / 180;

/// Of a camera that looks along `axis` and whose image is level: what a gimbal holds.
Eigen::Matrix3d levelAttitude(const Eigen::Vector3d& axis) {
  Eigen::Matrix3d R_GC;
  R_GC.col(2) = axis;
  R_GC.col(0) = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
  R_GC.col(1) = axis.cross(R_GC.col(0));
  return R_GC;
}

void addNote(MapView& view, const std::string& words) {
  if (!words.empty()) view.note += (view.note.empty() ? "" : "; ") + words;
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
    : channels_(configuration.channels),
      camera_(configuration.camera),
      R_IC_(configuration.inertial.extrinsics.R_CI.transpose()),
      timeshift_us_(fromSeconds(configuration.inertial.extrinsics.timeshift_s).count()),
      has_gimbal_(configuration.geolocation.mount == "gimbal" || configuration.inertial.gimbal.enabled),
      has_autopilot_(!configuration.autopilot.link.empty()),
      zooms_(configuration.inertial.lens.enabled) {}

void MapBuilder::onPose(const pose_t& pose) {
  pose_ = pose;
  const auto place = frame_.placeOf(vehiclePoseOf(pose));
  if (frame_.takeRestart()) {
    path_.clear();
    targets_.restart();
  }
  position_ = place ? std::optional<Eigen::Vector2d>(place->position) : std::nullopt;
  if (!position_ || (!path_.empty() && (path_.back() - *position_).norm() < kPathStep_m)) return;
  path_.push_back(*position_);
  if (path_.size() > kLongestPath) path_.pop_front();
}

void MapBuilder::onTargets(const targets_t& targets) { targets_.take(targets, frame_, ownAt(targets.utime)); }

/// The last position, carried to a time within a second of it (us, camera clock).
std::optional<Eigen::Vector2d> MapBuilder::ownAt(int64_t utime) const {
  if (!position_) return std::nullopt;
  const int64_t since_us = utime + timeshift_us_ - pose_->utime;
  if (std::abs(since_us) > kStale_us) return std::nullopt;
  if (pose_->has_velocity == 0) return position_;
  return *position_ +
         static_cast<double>(since_us) / 1e6 * Eigen::Vector2d(pose_->velocity[0], pose_->velocity[1]);
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

bool MapBuilder::isFresh(int64_t utime) const {
  return targets_.hasBegun() && std::abs(utime - targets_.utime()) <= kStale_us;
}

MapView MapBuilder::view(int64_t utime) const {
  MapView view;
  view.path.assign(path_.begin(), path_.end());
  if (frame_.isGlobal()) view.origin = frame_.geodeticOf(Eigen::Vector2d::Zero());
  addOwn(utime, view);
  addTargets(utime, view);
  return view;
}

void MapBuilder::addOwn(int64_t utime, MapView& view) const {
  if (!pose_) {
    view.note = has_autopilot_
                    ? "no POSE has come from redbee-autopilot, whose line says why"
                    : "no POSE: the position comes from redbee-autopilot, which needs autopilot.link";
    return;
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
    return;
  }
  const Eigen::Matrix3d R_GI = quaternionOf(pose_->quat).toRotationMatrix();
  view.own = MapView::Own{*position_, std::atan2(R_GI(0, 0), R_GI(1, 0)), heightAt(utime), {}};
  addFootprint(isFresh(utime) ? targets_.camera() : std::nullopt, view);
}

/// By what TARGETS says of the camera, which heeds the gimbal and the altimeter; else by pose and mounting.
void MapBuilder::addFootprint(const std::optional<MapCamera>& camera, MapView& view) const {
  if (camera) view.own->height_m = camera->height_m;
  if (!view.own->height_m) {
    if (view.note.empty()) view.note = "no height above the ground: no footprint";
    return;
  }
  if (!camera && has_gimbal_) {
    if (view.note.empty()) view.note = "where the gimbal's camera looks is not known: no footprint";
    return;
  }
  const Eigen::Matrix3d R_GC = camera && has_gimbal_
                                   ? levelAttitude(camera->axis)
                                   : Eigen::Matrix3d(quaternionOf(pose_->quat).toRotationMatrix() * R_IC_);
  const Eigen::Vector3d axis = camera ? camera->axis : Eigen::Vector3d(R_GC.col(2));
  const Eigen::Vector2d at = camera ? camera->position : view.own->position;
  if (-axis.z() > std::sin(kShallowest_rad))
    view.own->axis_on_ground = at - axis.head<2>() / axis.z() * *view.own->height_m;
  if (camera && !camera->footprint.empty()) {
    view.footprint = camera->footprint;
    return;
  }
  if (zooms_) {
    if (view.note.empty()) view.note = "the lens zooms: no footprint but that of TARGETS";
    return;
  }
  for (const Eigen::Vector2d& corner : footprintOf(camera_, R_GC, *view.own->height_m))
    view.footprint.push_back(corner + at);
  if (view.footprint.empty() && view.note.empty())
    view.note = "the camera looks above the horizon: no footprint";
}

void MapBuilder::addTargets(int64_t utime, MapView& view) const {
  if (!targets_.hasBegun()) return;
  if (!isFresh(utime)) {
    const double age_s = targets_.ageAt(utime);
    addNote(view, age_s > 0 ? fmt::format("no TARGETS for {:.1f} s", age_s)
                            : fmt::format("TARGETS are {:.1f} s ahead of the camera", -age_s));
    return;
  }
  view.targets = targets_.targets();
  view.targets_utime = targets_.utime();
  const std::string words = wordsOfTargetStatus(targets_.status(), channels_);
  if (words.empty()) return;
  addNote(view, view.targets.empty() ? words + ": no targets" : words + ": targets are predicted");
}

}  // namespace redbee
