#include "redbee/detection/parallax/propagated_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr float kSmall = 1e-3F;
constexpr int kNeighbourhood_px = 3;  // residuals are averaged over it before they are compared with the past
// Evidence is not reduced while the residual is at least half of the propagated one (squared).
constexpr float kKeptBelow = 4;

/// Positions of the pixels in the previous image.
cv::Mat2f previousPlaces(const cv::Mat2f& back_step, const Eigen::Matrix3d& ground) {
  const Eigen::Matrix3f back = ground.inverse().cast<float>();
  cv::Mat2f places(back_step.size());
  for (int y = 0; y < places.rows; ++y) {
    const cv::Vec2f* step = back_step[y];
    cv::Vec2f* to = places[y];
    for (int x = 0; x < places.cols; ++x) {
      const float u = static_cast<float>(x) + step[x][0];
      const float v = static_cast<float>(y) + step[x][1];
      const float scale = 1 / (back(2, 0) * u + back(2, 1) * v + back(2, 2));
      to[x] = {(back(0, 0) * u + back(0, 1) * v + back(0, 2)) * scale,
               (back(1, 0) * u + back(1, 1) * v + back(1, 2)) * scale};
    }
  }
  return places;
}

cv::Mat4f fetch(const cv::Mat4f& map, const cv::Mat2f& places) {
  if (map.empty()) return cv::Mat4f::zeros(places.size());
  cv::Mat4f fetched;
  cv::remap(map, fetched, places, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return fetched;
}

}  // namespace

void PropagatedEvidence::reset() { moving_.release(); }

void PropagatedEvidence::update(const FrameEvidence& now, const Eigen::Matrix3d& ground,
                                const cv::Mat1b& unknown) {
  const cv::Mat2f places = previousPlaces(now.back_step, ground);
  cv::Mat4f moving = fetch(moving_, places);
  cv::Mat2f mean_residual;
  cv::blur(now.normalized_residual, mean_residual, {kNeighbourhood_px, kNeighbourhood_px});
  const auto half2 = static_cast<float>(parameters_.evidence_sigmas * parameters_.evidence_sigmas);
  const auto rate = static_cast<float>(parameters_.evidence_rate);
  for (int y = 0; y < moving.rows; ++y) {
    const cv::Vec2f* off = now.normalized_residual[y];
    const cv::Vec2f* around = mean_residual[y];
    cv::Vec4f* sum = moving[y];
    for (int x = 0; x < moving.cols; ++x) {
      // Background that an object has just uncovered is static where the object moved: it inherits no
      // evidence.
      const float then2 = sum[x][1] * sum[x][1] + sum[x][2] * sum[x][2];
      const float kept = std::min(1.0F, (kKeptBelow * around[x].dot(around[x]) + half2) / (then2 + half2));
      const float off2 = off[x].dot(off[x]);
      const cv::Vec4f newest(off2 / (off2 + half2), off[x][0], off[x][1], std::sqrt(off2));
      sum[x] = kept * (1 - rate) * sum[x] + rate * newest;
    }
  }
  moving.setTo(cv::Scalar::all(0), unknown);
  moving_ = moving;
}

cv::Mat1f PropagatedEvidence::motion() const {
  // Averaging reduces the variance of a single vector to about half.
  constexpr double kAveragedVariance = 0.5;
  const auto half2 =
      static_cast<float>(kAveragedVariance * parameters_.evidence_sigmas * parameters_.evidence_sigmas);
  cv::Mat1f motion(moving_.size());
  for (int y = 0; y < motion.rows; ++y) {
    const cv::Vec4f* sum = moving_[y];
    float* to = motion[y];
    for (int x = 0; x < motion.cols; ++x) {
      const float net2 = sum[x][1] * sum[x][1] + sum[x][2] * sum[x][2];
      const float coherence = net2 / (sum[x][3] * sum[x][3] + kSmall);
      to[x] = std::sqrt(sum[x][0] * coherence * net2 / (net2 + half2));
    }
  }
  return motion;
}

}  // namespace redbee
