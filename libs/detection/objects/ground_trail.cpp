#include "redbee/detection/objects/ground_trail.hpp"

#include <algorithm>

#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

constexpr double kSpan_s = 1.5;
constexpr size_t kFewest = 4;

}  // namespace

void GroundTrail::propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground) {
  if (!ground) {
    positions_.clear();
    return;
  }
  if (origin_) origin_ = transfer(*ground, *origin_);
  for (Position& position : positions_) {
    position.age_s += elapsed_s;
    position.centre = transfer(*ground, position.centre);
  }
  while (!positions_.empty() && positions_.front().age_s > kSpan_s) positions_.pop_front();
}

void GroundTrail::note(const Eigen::Vector2d& centre, double size_px) {
  if (!origin_) origin_ = centre;
  farthest_ = std::max(farthest_, (centre - *origin_).norm() / size_px);
  positions_.push_back({0, centre});
}

Eigen::Vector2d GroundTrail::velocity() const {
  if (positions_.size() < kFewest) return Eigen::Vector2d::Zero();
  double mean_age_s = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  const double weight = 1.0 / static_cast<double>(positions_.size());
  for (const Position& position : positions_) {
    mean_age_s += weight * position.age_s;
    mean += weight * position.centre;
  }
  double variance = 0;
  Eigen::Vector2d covariance = Eigen::Vector2d::Zero();
  for (const Position& position : positions_) {
    const double time_s = mean_age_s - position.age_s;
    variance += time_s * time_s;
    covariance += time_s * (position.centre - mean);
  }
  if (variance <= 0) return Eigen::Vector2d::Zero();
  return covariance / variance;
}

}  // namespace redbee
