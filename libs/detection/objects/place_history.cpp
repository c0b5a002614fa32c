#include "redbee/detection/objects/place_history.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

constexpr double kSpan_s = 5;
constexpr double kTolerance_px = 2;  // of a box's edges

bool covers(const cv::Rect& box, const Eigen::Vector2d& at) {
  return at.x() >= box.x && at.x() < box.x + box.width && at.y() >= box.y && at.y() < box.y + box.height;
}

}  // namespace

void PlaceHistory::propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground) {
  duration_s_ = elapsed_s;
  if (!ground) {
    frames_.clear();
    return;
  }
  const Eigen::Matrix3d back = ground->inverse();
  for (Frame& frame : frames_) {
    frame.age_s += elapsed_s;
    frame.from_current = normaliseHomography(frame.from_current * back);
  }
  while (!frames_.empty() && frames_.front().age_s > kSpan_s) frames_.pop_front();
}

void PlaceHistory::note(const std::vector<Component>& components) {
  if (components.empty()) return;
  frames_.push_back({0, duration_s_, Eigen::Matrix3d::Identity(), {}});
  for (const Component& component : components) frames_.back().boxes.push_back(component.box);
}

double PlaceHistory::occupiedBefore(const cv::Rect2d& box, const Eigen::Vector2d& velocity) const {
  const Eigen::Vector2d place(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  double occupied_s = 0;
  for (const Frame& frame : frames_) {
    const Eigen::Vector2d moved = frame.age_s * velocity;
    const bool was_here = std::abs(moved.x()) <= 0.5 * box.width + kTolerance_px &&
                          std::abs(moved.y()) <= 0.5 * box.height + kTolerance_px;
    if (was_here) continue;
    const Eigen::Vector2d at = transfer(frame.from_current, place);
    const auto is_at_place = [&](const cv::Rect& other) { return covers(other, at); };
    if (std::any_of(frame.boxes.begin(), frame.boxes.end(), is_at_place)) occupied_s += frame.duration_s;
  }
  return occupied_s;
}

}  // namespace redbee
