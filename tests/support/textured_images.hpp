// Textured images moved by a known homography.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/tracks.hpp"
#include "redbee/visual/point_tracker.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

/// White noise of this mean and sigma; CV_8U.
inline cv::Mat noiseImage(cv::Size size, int seed, double mean, double sigma) {
  cv::Mat image(size, CV_8U);
  cv::RNG rng(static_cast<uint64_t>(seed));
  rng.fill(image, cv::RNG::NORMAL, mean, sigma);
  return image;
}

/// Motion over the ground at 6 m height, camera pitched 40 degrees down, during 1/24 s at this rate and
/// velocity.
inline PlaneMotion groundMotion(const Eigen::Vector3d& rate_deg_s, const Eigen::Vector3d& velocity) {
  const double dt = 1.0 / 24;
  const double pitch = 40 * M_PI / 180;
  return {expSO3(rate_deg_s * (M_PI / 180 * dt)), velocity * dt, {0, std::cos(pitch), std::sin(pitch)}, 6.0};
}

inline Eigen::Matrix3d groundHomography(const Eigen::Vector3d& rate_deg_s, const Eigen::Vector3d& velocity) {
  return planeHomography(camera().K(), groundMotion(rate_deg_s, velocity));
}

/// A band-limited random texture with a margin around the image, so that a moved view has no empty parts.
class Canvas {
 public:
  static constexpr int kMargin = 120;

  explicit Canvas(unsigned seed, double mean = 120, double contrast = 30) {
    cv::RNG rng(seed);
    cv::Mat fine(kHeight + 2 * kMargin, kWidth + 2 * kMargin, CV_32F);
    cv::Mat coarse(fine.size(), CV_32F);
    rng.fill(fine, cv::RNG::NORMAL, 0, 1);
    rng.fill(coarse, cv::RNG::NORMAL, 0, 1);
    cv::GaussianBlur(fine, fine, {}, 1.6);
    cv::GaussianBlur(coarse, coarse, {}, 7);
    texture_ = unitVariance(fine) + unitVariance(coarse);
    texture_ = texture_ * (contrast / std::sqrt(2.0)) + mean;
  }

  /// The image after motion by H (pixels of the unmoved view to those of this one), with white noise.
  cv::Mat view(const Eigen::Matrix3d& H, double noise_sigma, unsigned noise_seed) const {
    Eigen::Matrix3d to_canvas = Eigen::Matrix3d::Identity();
    to_canvas(0, 2) = to_canvas(1, 2) = kMargin;
    const Eigen::Matrix3d M = to_canvas * H.inverse();
    cv::Mat_<double> map(3, 3);
    for (int i = 0; i < 9; ++i) map(i / 3, i % 3) = M(i / 3, i % 3);
    cv::Mat image, noise(kHeight, kWidth, CV_32F), grey;
    cv::warpPerspective(texture_, image, map, {kWidth, kHeight}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
    cv::RNG rng(noise_seed);
    rng.fill(noise, cv::RNG::NORMAL, 0, noise_sigma);
    cv::Mat(image + noise).convertTo(grey, CV_8U);
    return grey;
  }

 private:
  static cv::Mat unitVariance(const cv::Mat& map) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(map, mean, deviation);
    return (map - mean[0]) / deviation[0];
  }
  cv::Mat texture_;
};

inline PointTracks toTracks(const simulation::SimulatedTracks& simulated) {
  PointTracks tracks;
  for (std::size_t i = 0; i < simulated.before.size(); ++i) {
    tracks.previous.emplace_back(simulated.before[i].x(), simulated.before[i].y());
    tracks.current.emplace_back(simulated.after[i].x(), simulated.after[i].y());
  }
  tracks.sampled = static_cast<int>(tracks.previous.size());
  return tracks;
}

}  // namespace redbee::test
