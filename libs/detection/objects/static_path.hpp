// Whether a track moves over the scene, or its path is that of a static surface of unknown depth, which the
// camera's travel explains. libs/README.md, (38).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {

/// The camera's motion over one step, and the camera matrices before and after it [px].
struct CameraStep {
  PlaneMotion motion;
  CameraPair cameras;
};

/// The camera's motion over the latest 1.5 s: from each of these frames to the current one.
class CameraPath {
 public:
  /// `nearest_depth_fraction`: of the height, see ParallaxParameters.
  explicit CameraPath(double nearest_depth_fraction) : nearest_depth_fraction_(nearest_depth_fraction) {}

  /// To the next frame. `ground`: homography, previous to current [px]. Frames before a step that is not
  /// known are forgotten.
  void propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground,
                 const std::optional<CameraStep>& step);
  /// Number of the current frame; 0 before the first step.
  int64_t current() const { return current_; }

  /// Where a static point, seen at a pixel of an earlier frame, would be in the current one: at `base` on the
  /// ground (above the horizon: at infinity), at base + parallax at the smallest plausible depth, in between
  /// at any other [px].
  struct Sighting {
    double age_s;
    Eigen::Vector2d base;
    Eigen::Vector2d parallax;
  };
  /// Whether project() knows this frame.
  bool remembers(int64_t frame) const;
  /// Precondition: remembers().
  Sighting project(int64_t frame, const Eigen::Vector2d& pixel) const;

 private:
  struct Frame {
    double age_s;
    SceneMotion scene;  ///< from it to the current frame
    PlaneMotion motion;
    Eigen::Matrix3d K;        ///< its own
    Eigen::Vector3d epipole;  ///< [px]: of a surface at the smallest plausible depth
  };

  int64_t oldest() const { return current_ - static_cast<int64_t>(frames_.size()); }

  double nearest_depth_fraction_;
  int64_t current_ = 0;
  std::deque<Frame> frames_;  ///< before the current one, oldest first
};

/// One sighting of a path.
struct PathObservation {
  CameraPath::Sighting seen;
  Eigen::Matrix2d whitening;  ///< inverse root of the position's covariance [1/px]
};

/// Two explanations of a path by weighted least squares. A path that both explain says nothing.
struct PathFit {
  double
      static_chi2;  ///< of the best static point, at any depth from the ground to the nearest plausible one
  double moving_chi2;  ///< of the best point that moves over the ground at a constant velocity
};
/// `observations`: two or more; positions relative to one near them, so that the numbers are small.
/// `direction_error`: rad, sigma of the direction of travel.
PathFit fitPath(const std::vector<PathObservation>& observations, double direction_error);

/// fitPath() where the position is as sure in all sightings: by sums over them, at a fraction of its cost.
class UniformPathFit {
 public:
  /// Two or more; positions as there.
  void add(const CameraPath::Sighting& seen);
  size_t size() const { return count_; }
  PathFit solve(const Eigen::Matrix2d& whitening, double direction_error) const;

 private:
  size_t count_ = 0;
  double age_ = 0, age_age_ = 0;
  Eigen::Vector2d base_ = Eigen::Vector2d::Zero(), parallax_ = base_, age_base_ = base_;
  Eigen::Matrix2d base_base_ = Eigen::Matrix2d::Zero(), parallax_base_ = base_base_,
                  parallax_parallax_ = base_base_;
};

/// Where a track was found in one frame.
struct PathPoint {
  int64_t frame;  ///< CameraPath::current() of then
  Eigen::Vector2d centre_px;
  Eigen::Vector2d variance_px2;
};

/// Log likelihood ratio of two paths fitted to the points (oldest first): of a point that moves over the
/// ground at a constant velocity, against one that rests at any depth. About 0, or less, where the camera's
/// travel explains it all, also what moves along the parallax. `direction_error`: rad, sigma of the
/// direction of travel. std::nullopt for less than four points that the camera's path still knows.
std::optional<double> movingLogLikelihood(const std::deque<PathPoint>& points, const CameraPath& camera,
                                          double direction_error);

}  // namespace redbee
