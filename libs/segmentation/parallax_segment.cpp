#include "segmentation/parallax_segment.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr float kNoDirection = 1e-6F;

float squared(double value) { return static_cast<float>(value * value); }

}  // namespace

ParallaxSegment::ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                                 const SegmentationParameters& parameters)
    : noise_variance_(squared(parameters.parallax_noise_px)),
      direction_variance_(squared(parameters.direction_error)) {
  if (!motion || !parameters.use_epipolar) return;
  const Eigen::Vector3f e = (K * motion->t_ba / (parameters.nearest_depth_share * motion->h_a)).cast<float>();
  epipole_ = {e.x(), e.y(), e.z()};
}

ParallaxSegment::Verdict ParallaxSegment::judge(const cv::Vec2f& ground, const cv::Vec2f& flow) const {
  // A point at depth z lies at (a + e / z) / (a_3 + e_3 / z), a its image at infinity: whatever the depth, it
  // moves along e_12 - e_3 ground.
  const float dx = epipole_[0] - epipole_[2] * ground[0];
  const float dy = epipole_[1] - epipole_[2] * ground[1];
  const float length = std::sqrt(dx * dx + dy * dy);
  if (length < kNoDirection) return {{0, 0}, flow.dot(flow) / noise_variance_};
  const float ux = dx / length;
  const float uy = dy / length;
  const float along = flow[0] * ux + flow[1] * uy;
  const float across = flow[0] * uy - flow[1] * ux;
  const float nearest = std::clamp(along, 0.0F, length);
  const float beyond = along - nearest;
  const float variance = noise_variance_ + direction_variance_ * along * along;
  return {{nearest * ux, nearest * uy}, (across * across + beyond * beyond) / variance};
}

}  // namespace redbee
