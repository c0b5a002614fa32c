#include "redbee/detection/parallax/parallax_segment.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr double kPlanesError = 3;  // times the direction's error with an IMU
constexpr float kNoDirection = 1e-6F;

}  // namespace

ParallaxSegment::ParallaxSegment(const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K,
                                 const ParallaxParameters& parameters)
    : direction_variance_(static_cast<float>(parameters.direction_error * parameters.direction_error)) {
  if (!motion || !parameters.use_epipolar) return;
  const Eigen::Vector3f e =
      (K * motion->t_ba / (parameters.nearest_depth_fraction * motion->h_a)).cast<float>();
  epipole_ = {e.x(), e.y(), e.z()};
}

ParallaxSegment::ParallaxSegment(const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                                 const ParallaxParameters& parameters)
    : direction_variance_(static_cast<float>(std::pow(kPlanesError * parameters.direction_error, 2))) {
  if (parameters.use_epipolar) to_front_ = cv::Matx33f(toMatx(front * ground.inverse()));
}

ParallaxSegment::ParallaxSegment(const cv::Vec3f& epipole, const ParallaxParameters& parameters)
    : epipole_(epipole),
      direction_variance_(static_cast<float>(std::pow(kPlanesError * parameters.direction_error, 2))) {}

/// From the position on the ground to that on the nearest static surface.
cv::Vec2f ParallaxSegment::end(const cv::Vec2f& ground) const {
  constexpr float kBeyondFront = 1.5F;  // for parts that protrude from the plane
  // A point at depth z lies at (a + e / z) / (a_3 + e_3 / z), a its image at infinity: whatever the depth, it
  // moves along e_12 - e_3 ground.
  if (!to_front_) return parallaxOf(epipole_, ground);
  const cv::Vec3f front = *to_front_ * cv::Vec3f(ground[0], ground[1], 1);
  return kBeyondFront * (cv::Vec2f(front[0], front[1]) / front[2] - ground);
}

ParallaxSegment::Ray ParallaxSegment::ray(const cv::Vec2f& ground) const {
  const cv::Vec2f towards = end(ground);
  const float length = std::sqrt(towards.dot(towards));
  if (length < kNoDirection) return {{0, 0}, 0};
  return {towards * (1 / length), length};
}

cv::Vec2f ParallaxSegment::direction(const cv::Vec2f& ground) const { return ray(ground).direction; }

ParallaxSegment::Residual ParallaxSegment::residual(const cv::Vec2f& ground, const cv::Vec2f& flow,
                                                    const Symmetric2f& noise) const {
  const auto [direction, length] = ray(ground);
  const float along = flow.dot(direction);
  const cv::Vec2f across(-direction[1], direction[0]);
  const Symmetric2f outer(across[0] * across[0], across[0] * across[1], across[1] * across[1]);
  const Symmetric2f root = inverseRoot(noise + direction_variance_ * along * along * outer);
  const cv::Vec2f whitened = root * flow;
  if (length == 0) return {{0, 0}, whitened};
  const cv::Vec2f step = root * direction;
  const float nearest = std::clamp(whitened.dot(step) / step.dot(step), 0.0F, length);
  return {nearest * direction, whitened - nearest * step};
}

bool runsOutOfImage(const PointTracks& tracks, const Eigen::Matrix3d& ground, const Eigen::Matrix3d& front,
                    cv::Size image) {
  constexpr double kExplained_px = 1.5;
  constexpr double kBorderFraction = 1.0 / 12;  // of the image's height
  constexpr double kLeastFraction = 0.1;        // of the points, near the border
  const double border = kBorderFraction * image.height;
  int on_front = 0, at_border = 0;
  for (size_t i = 0; i < tracks.current.size(); ++i) {
    const Eigen::Vector2d before(tracks.previous[i].x, tracks.previous[i].y);
    const Eigen::Vector2d now(tracks.current[i].x, tracks.current[i].y);
    if ((transfer(front, before) - now).norm() > kExplained_px) continue;
    if ((transfer(ground, before) - now).norm() <= kExplained_px) continue;
    ++on_front;
    const double to_border =
        std::min({now.x(), now.y(), image.width - 1 - now.x(), image.height - 1 - now.y()});
    if (to_border < border) ++at_border;
  }
  return on_front > 0 && at_border >= kLeastFraction * on_front;
}

}  // namespace redbee
