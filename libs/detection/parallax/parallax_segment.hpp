// Residual flow that a static surface can have, once the ground's motion has been taken out (plane plus
// parallax; Irani and Anandan 1998).
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// A static surface nearer than the ground has moved along the line through the epipole e = K t, away from
/// where the ground would be, and no further than the nearest plausible depth allows: its remaining flow lies
/// on a known segment, from 0 to where that nearest surface would be. Without an IMU the front plane gives
/// the segment: surfaces between the two planes move by less, those in front of it by somewhat more. With
/// neither the segment is the point 0.
class ParallaxSegment {
 public:
  ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                  const ParallaxParameters& parameters);
  /// Both homographies from the earlier frame to the current one. Their difference gives the direction less
  /// accurately than an IMU.
  ParallaxSegment(const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                  const ParallaxParameters& parameters);

  struct Residual {
    cv::Vec2f nearest;              ///< px: the point of the segment that is nearest to the flow
    cv::Vec2f normalized_residual;  ///< from there to the flow, over its standard deviation
    float squaredMahalanobis() const { return normalized_residual.dot(normalized_residual); }
  };
  /// `ground`: where the scene point would be in the current image if it lay on the ground [px]; `flow`:
  /// from there to where it is [px], of variance `noise_variance` [px^2].
  Residual residual(const cv::Vec2f& ground, const cv::Vec2f& flow, float noise_variance) const;
  /// Unit vector of the parallax at `ground`; 0 where there is none.
  cv::Vec2f direction(const cv::Vec2f& ground) const;

  struct Ray {
    cv::Vec2f direction;  ///< unit; 0 where there is no parallax
    float length;         ///< px; 0 there
  };
  /// The segment at `ground`.
  Ray ray(const cv::Vec2f& ground) const;

 private:
  cv::Vec2f end(const cv::Vec2f& ground) const;

  cv::Vec3f epipole_{0, 0, 0};           ///< K t over the nearest depth
  std::optional<cv::Matx33f> to_front_;  ///< the ground's place of a pixel to the front plane's
  float direction_variance_;             ///< rad^2
};

/// Whether the points on the front plane (and not on the ground) extend to the image's border, as those of
/// static structures do: an island in the ground is more likely a moving object. Homographies previous to
/// current.
bool runsOutOfImage(const PointTracks& tracks, const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                    cv::Size image);

}  // namespace redbee
