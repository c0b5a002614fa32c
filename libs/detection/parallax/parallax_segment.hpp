// The residual flow that static surfaces can have after compensation of the ground's motion (plane plus
// parallax; Irani and Anandan 1998).
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/parallax/flow_covariance.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// Vector of the parallax at position `ground` [px], of an epipole e (homogeneous): e_12 - e_3 ground.
inline cv::Vec2f parallaxOf(const cv::Vec3f& epipole, const cv::Vec2f& ground) {
  return {epipole[0] - epipole[2] * ground[0], epipole[1] - epipole[2] * ground[1]};
}

/// The residual flow of a static surface nearer than the ground lies on the line through the epipole e = K t,
/// between 0 (ground) and the flow of a surface at the smallest plausible depth. Without an IMU the front
/// plane gives the segment, somewhat extended for surfaces in front of it. With neither the segment is the
/// point 0.
class ParallaxSegment {
 public:
  ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                  const ParallaxParameters& parameters);
  /// Both homographies: earlier frame to current one. Their difference gives the direction less accurately
  /// than an IMU.
  ParallaxSegment(const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                  const ParallaxParameters& parameters);

  /// `epipole`: findEpipole().
  ParallaxSegment(const cv::Vec3f& epipole, const ParallaxParameters& parameters);

  struct Residual {
    cv::Vec2f nearest;              ///< px: point of the segment closest to the flow, by Mahalanobis distance
    cv::Vec2f normalized_residual;  ///< flow minus that point, times the inverse root of its covariance
    float squaredMahalanobis() const { return normalized_residual.dot(normalized_residual); }
  };
  /// `ground`: position of the scene point in the current image if it lay on the ground [px]; `flow`: from
  /// there to its actual position [px], of covariance `noise` [px^2]. The direction's error adds to it.
  Residual residual(const cv::Vec2f& ground, const cv::Vec2f& flow, const Symmetric2f& noise) const;
  /// The epipole, 0 without parallax; std::nullopt if the segment is the front plane's.
  std::optional<cv::Vec3f> epipole() const { return to_front_ ? std::nullopt : std::optional(epipole_); }
  float directionVariance() const { return direction_variance_; }
  /// Unit vector of the parallax at `ground`; 0 where there is none.
  cv::Vec2f direction(const cv::Vec2f& ground) const;

 private:
  struct Ray {
    cv::Vec2f direction;  ///< unit; 0 where there is no parallax
    float length;         ///< px; 0 there
  };
  cv::Vec2f end(const cv::Vec2f& ground) const;
  Ray ray(const cv::Vec2f& ground) const;

  cv::Vec3f epipole_{0, 0, 0};           ///< K t over the nearest depth
  std::optional<cv::Matx33f> to_front_;  ///< position on the ground to position on the front plane
  float direction_variance_;             ///< rad^2
};

/// True if the points on the front plane (and not on the ground) extend to the image's border, as those of
/// static structures do; otherwise the plane is more likely a moving object. Homographies: previous to
/// current.
bool runsOutOfImage(const PointTracks& tracks, const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                    cv::Size image);

}  // namespace redbee
