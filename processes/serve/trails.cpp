#include "processes/serve/trails.hpp"

#include <Eigen/Geometry>
#include <iterator>
#include <optional>

#include "processes/detection_messages.hpp"

namespace redbee {
namespace {

constexpr size_t kMostSteps = 64;  ///< some seconds of frames whose detections are yet to come

/// std::nullopt where the point passes the horizon.
std::optional<Eigen::Vector2d> carried(const Eigen::Matrix3d& H, const Eigen::Vector2d& point) {
  constexpr double kFarthest_px = 1e5;
  const Eigen::Vector3d moved = H * point.homogeneous();
  if (!(moved.z() > 0)) return std::nullopt;
  const Eigen::Vector2d result = moved.hnormalized();
  if (!(result.norm() < kFarthest_px)) return std::nullopt;
  return result;
}

}  // namespace

void Trails::addStep(int64_t from, int64_t to, const Eigen::Matrix3d& H) {
  if (from >= to) return;
  steps_[to] = {from, H};
  while (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
}

/// Returns whether steps lead from the last frame to this one.
bool Trails::carryTo(int64_t utime) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  int64_t at = utime;
  while (at > utime_) {
    const auto step = steps_.find(at);
    if (step == steps_.end()) return false;
    H = H * step->second.H;
    at = step->second.from;
  }
  if (at != utime_) return false;
  for (auto& [id, trail] : points_) {
    std::deque<Point> kept;
    for (const Point& point : trail) {
      const auto moved = carried(H, point.ideal);
      if (moved && point.utime > utime - kLength_us) kept.push_back({point.utime, *moved});
    }
    trail.swap(kept);
  }
  return true;
}

void Trails::addDetections(const detections_t& detections) {
  // A clock that was set back: the steps of later times would crowd out those that are to come.
  if (detections.utime < utime_) steps_.clear();
  if (!carryTo(detections.utime)) points_.clear();
  utime_ = detections.utime;
  for (const detection_t& d : detections.detections) {
    const auto foot = camera_.undistort(lowerMiddle(d));
    if (foot) points_[d.id].push_back({detections.utime, *foot});
  }
  for (auto trail = points_.begin(); trail != points_.end();)
    trail = trail->second.empty() ? points_.erase(trail) : std::next(trail);
}

std::vector<Trail> Trails::trails() const {
  std::vector<Trail> result;
  for (const auto& [id, points] : points_) {
    Trail trail{id, {}};
    for (const Point& point : points) {
      if (const auto raw = camera_.distort(point.ideal)) trail.points.push_back(*raw);
    }
    if (trail.points.size() > 1) result.push_back(std::move(trail));
  }
  return result;
}

}  // namespace redbee
