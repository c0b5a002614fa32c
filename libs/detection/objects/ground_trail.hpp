// Where on the ground a track has been.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace redbee {

/// Positions of a track, carried to the current frame with the ground.
class GroundTrail {
 public:
  /// To the next frame. `ground`: homography, previous to current [px].
  void propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground);
  /// Position of the track in the current frame, and root of its box's area [px].
  void note(const Eigen::Vector2d& centre, double size_px);
  /// Distance from where it began, in roots of its box's area, the greatest so far.
  double farthest() const { return farthest_; }
  /// Over the ground, fitted to the latest 1.5 s [px/s]; 0 for less than four positions.
  Eigen::Vector2d velocity() const;

 private:
  struct Position {
    double age_s;
    Eigen::Vector2d centre;
  };

  std::optional<Eigen::Vector2d> origin_;
  double farthest_ = 0;
  std::deque<Position> positions_;  ///< oldest first
};

}  // namespace redbee
