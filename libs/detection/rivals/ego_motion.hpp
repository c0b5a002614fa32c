// The camera's motion between two frames, for the rivals that use it.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/detection/rivals/grid_flow.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Static points at inverse depth s along the ray of a previous pixel lie at q + s e in the current image
/// (homogeneous), for s between two bounds.
class EgoMotion {
 public:
  /// From an IMU. The scene is no nearer than `nearest_fraction` of the height, and no deeper than the ground
  /// plane, whose depth is accurate to `ground_slack`.
  EgoMotion(const PlaneMotion& motion, const CameraPair& cameras, double nearest_fraction,
            double ground_slack);
  /// From the tracks alone: essential matrix (Nister's five points, RANSAC). Depth is only known to be
  /// positive, and is taken to be at least `nearest_baselines` times the length of travel. std::nullopt if
  /// too few points agree.
  static std::optional<EgoMotion> fromTracks(const GridTracks& tracks, const Eigen::Matrix3d& K,
                                             double nearest_baselines);

  /// Possible positions in the current image of a static scene point seen at `previous`: a segment [px].
  struct Segment {
    Eigen::Vector2d farthest, nearest;
  };
  /// std::nullopt for a ray that the motion moves behind the camera.
  std::optional<Segment> segmentOf(const cv::Point2f& previous) const;

 private:
  EgoMotion(const Eigen::Matrix3d& R, const Eigen::Vector3d& t, const CameraPair& cameras);

  Eigen::Matrix3d rotation_;  ///< K_b R K_a^-1
  Eigen::Vector3d epipole_;   ///< K_b t
  Eigen::Vector3d ground_ =
      Eigen::Vector3d::Zero();  ///< inverse depth of the ground at a pixel x is ground_' x
  double nearest_inverse_depth_ = 0;
};

/// From the closest point of the segment to `current` [px].
Eigen::Vector2d segmentResidual(const EgoMotion::Segment& segment, const cv::Point2f& current);

}  // namespace redbee
