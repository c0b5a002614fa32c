// Where a static surface may have moved in the picture, once the ground's motion has been taken out (plane
// plus parallax; Irani and Anandan 1998).
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "geometry/homography.hpp"
#include "segmentation/parameters.hpp"

namespace redbee {

/// A static surface nearer than the ground has moved along the line through the epipole e = K t, away from
/// where the ground would be, and no further than the nearest plausible depth allows: its remaining flow lies
/// on a known segment, from 0 to where that nearest surface would be. Without a camera motion the segment is
/// the point 0.
class ParallaxSegment {
 public:
  ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                  const SegmentationParameters& parameters);

  struct Verdict {
    cv::Vec2f nearest;        ///< px: the point of the segment that is nearest to the flow
    cv::Vec2f off_in_sigmas;  ///< from there to the flow, over its standard deviation
    float sigmasSquared() const { return off_in_sigmas.dot(off_in_sigmas); }
  };
  /// `ground`: where the scene point would be in the current picture if it lay on the ground [px]; `flow`:
  /// from there to where it is [px], of variance `noise_variance` [px^2].
  Verdict judge(const cv::Vec2f& ground, const cv::Vec2f& flow, float noise_variance) const;

 private:
  cv::Vec3f epipole_{0, 0, 0};  ///< K t over the nearest depth
  float direction_variance_;    ///< rad^2
};

}  // namespace redbee
