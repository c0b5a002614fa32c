#include "segmentation/parallax_segment.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {

ParallaxSegment::ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                                 const SegmentationParameters& parameters)
    : direction_variance_(static_cast<float>(parameters.direction_error * parameters.direction_error)) {
  if (!motion || !parameters.use_epipolar) return;
  const Eigen::Vector3f e = (K * motion->t_ba / (parameters.nearest_depth_share * motion->h_a)).cast<float>();
  epipole_ = {e.x(), e.y(), e.z()};
}

ParallaxSegment::Verdict ParallaxSegment::judge(const cv::Vec2f& ground, const cv::Vec2f& flow,
                                                float noise_variance) const {
  constexpr float kNoDirection = 1e-6F;
  // A point at depth z lies at (a + e / z) / (a_3 + e_3 / z), a its image at infinity: whatever the depth, it
  // moves along e_12 - e_3 ground.
  const cv::Vec2f towards(epipole_[0] - epipole_[2] * ground[0], epipole_[1] - epipole_[2] * ground[1]);
  const float length = std::sqrt(towards.dot(towards));
  if (length < kNoDirection) return {{0, 0}, flow * (1 / std::sqrt(noise_variance))};
  const cv::Vec2f direction = towards * (1 / length);
  const float along = flow.dot(direction);
  const cv::Vec2f nearest = direction * std::clamp(along, 0.0F, length);
  const float sigma = std::sqrt(noise_variance + direction_variance_ * along * along);
  return {nearest, (flow - nearest) * (1 / sigma)};
}

}  // namespace redbee
