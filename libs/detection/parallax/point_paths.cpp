#include "redbee/detection/parallax/point_paths.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/geometry/compose_motion.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

constexpr double kSampleEvery_s = 0.079;  // two frames at 24 Hz, and times are rounded
constexpr size_t kFewestSamples = 4;
constexpr double kCorrelatedSamples = 2;  // samples whose errors are about as good as one independent one

constexpr int kWindow_px = 7;  // as small as the objects that the dense flow misses
constexpr int kCell_px = 14;   // full size: at most one point begins in each
constexpr AlignmentLimits kLimits{10, 0.03};
// Grey levels^2 per px^2, the smaller eigenvalue of the mean gradient matrix where a point begins; it is
// followed down to half of it.
constexpr double kTexture = 25;
constexpr double kForwardBackward_px = 0.35;
constexpr double kMostDifference = 20;      // grey levels, mean absolute difference of the two patches
constexpr double kFarthest_px = 16;         // full size, from where a static point of the ground would be
constexpr double kVelocitySmoothing = 0.5;  // weight of the newest

// A position's error: one sigma [px at full size] over good texture, and the gradient [grey levels per px] at
// which its variance along it doubles, as of the dense flow (27).
constexpr double kNoise_px = 0.4;
constexpr double kMinGradient = 5;

constexpr double kRegistrationNoise_px = 0.7;  // full size
constexpr float kRegistrationExpected_px = 2;  // full size, of the composed homographies
constexpr double kLeastParallax_px = 1;        // full size: below, both components are the registration's
constexpr int kRegistrationIterations = 2;
constexpr size_t kRegistrationPoints = 300;  // more do not make it better

cv::Point pixelAt(const Eigen::Vector2d& p) { return {cvRound(p.x()), cvRound(p.y())}; }

/// Inverse root of the covariance of a position [1/px]. `tensor`: around it.
Eigen::Matrix2d whiteningOf(const Symmetric2f& tensor, double sigma_px) {
  constexpr double kMinGradient2 = kMinGradient * kMinGradient;
  const Symmetric2f root = inverseRoot(displacementCovariance(tensor, static_cast<float>(sigma_px * sigma_px),
                                                              static_cast<float>(kMinGradient2)));
  Eigen::Matrix2d whitening;
  whitening << root[0], root[1], root[1], root[2];
  return whitening;
}

bool isExcluded(const cv::Mat1b& excluded, const cv::Point& at) {
  return !excluded.empty() && excluded(at) != 0;
}

}  // namespace

PointPaths::PointPaths(const ParallaxParameters& parameters)
    : scale_(std::max(parameters.work_downscale, 1)),
      direction_error_(parameters.direction_error),
      shape_(kWindow_px),
      forward_(shape_),
      backward_(shape_),
      camera_(parameters.nearest_depth_fraction),
      texture_(kWindow_px, std::max(2, static_cast<int>(std::lround(kCell_px / scale_))), kTexture) {}

void PointPaths::reset() {
  paths_.clear();
  samples_.clear();
  previous_.clear();
  last_time_.reset();
  ground_.reset();
  motion_.reset();
}

void PointPaths::propagate(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion) {
  motion_ = ground_ ? compose(motion, motion_) : motion;
  ground_ = ground_ ? normaliseHomography(ground * *ground_) : ground;
}

void PointPaths::update(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
                        const cv::Mat1b& excluded) {
  constexpr int kLeastSide_px = 24;
  if (std::exchange(size_, grey.size()) != grey.size()) reset();
  const double elapsed_s = seconds(time - last_time_.value_or(time));
  const bool continues = !previous_.empty() && ground_ && motion_;
  const CameraPair K_pair(last_time_ ? K_ : K, K);
  camera_.propagate(elapsed_s, ground_, motion_ ? std::optional(CameraStep{*motion_, K_pair}) : std::nullopt);
  if (ground_ && !motion_) return reset();  // no path can be told from a static one's
  Pyramid image(grey, 1, shape_.margin(), kLeastSide_px);
  since_sample_s_ += elapsed_s;
  const bool is_sampled = !continues || samples_.empty() || since_sample_s_ >= kSampleEvery_s;
  if (continues) {
    follow(image, *ground_, excluded);
    if (is_sampled) registerSamples();
  } else {
    reset();
  }
  findTexture(grey);
  if (is_sampled) {  // in between a test says little more
    for (size_t i = 0; i < paths_.size(); ++i) test(paths_[i], texture_.atPoints()[i]);
  }
  begin(excluded);
  if (is_sampled) sample();
  previous_ = std::move(image);
  last_time_ = time;
  K_ = K;
  ground_.reset();
  motion_.reset();
}

bool PointPaths::isInside(const Eigen::Vector2d& p) const {
  const double edge = shape_.half + 1;
  return p.x() >= edge && p.y() >= edge && p.x() <= size_.width - 1 - edge &&
         p.y() <= size_.height - 1 - edge;
}

void PointPaths::follow(const Pyramid& image, const Eigen::Matrix3d& ground, const cv::Mat1b& excluded) {
  size_t kept = 0;
  for (PointPath& path : paths_) {
    if (advance(path, image, ground) && !isExcluded(excluded, pixelAt(path.at))) paths_[kept++] = path;
  }
  paths_.resize(kept);
}

void PointPaths::findTexture(const cv::Mat1b& grey) {
  pixels_.clear();
  for (const PointPath& path : paths_) pixels_.push_back(pixelAt(path.at));
  texture_.find(grey, pixels_);
}

/// From the whole pixel next to it, where the template needs no interpolation. False if it is lost.
bool PointPaths::advance(PointPath& path, const Pyramid& image, const Eigen::Matrix3d& ground) {
  const Eigen::Vector2d nearest = path.at.array().round();
  const cv::Point from = pixelAt(nearest);
  forward_.extract(previous_[0], from.x, from.y);
  if (forward_.smallestEigenvalue() < kTexture / 2) return false;
  const Eigen::Vector2d on_ground = transfer(ground, nearest);
  if (!on_ground.allFinite() || !isInside(on_ground)) return false;
  Eigen::Vector2d found = on_ground + path.velocity;
  if (forward_.align(image[0], found, kLimits) != Alignment::kConverged) {
    found = on_ground;
    if (forward_.align(image[0], found, kLimits) != Alignment::kConverged) return false;
  }
  if (!isInside(found) || (found - on_ground).norm() > kFarthest_px / scale_) return false;
  if (forward_.residual(image[0], found) > kMostDifference) return false;
  const Eigen::Vector2d displacement = found - nearest;
  const cv::Point there = pixelAt(found);
  backward_.extract(image[0], there.x, there.y);
  const Eigen::Vector2d expected = Eigen::Vector2d(there.x, there.y) - displacement;
  Eigen::Vector2d back = expected;
  if (backward_.align(previous_[0], back, kLimits) == Alignment::kLost) return false;
  if ((back - expected).norm() > kForwardBackward_px) return false;
  path.velocity += kVelocitySmoothing * (found - on_ground - path.velocity);
  path.at += displacement;
  return true;
}

CameraPath::Sighting PointPaths::sighting(const Sample& sample, const Eigen::Vector2d& at) const {
  CameraPath::Sighting seen = camera_.project(sample.frame, at);
  const cv::Vec2f error =
      sample.error.at(static_cast<float>(seen.base.x()), static_cast<float>(seen.base.y()));
  seen.base += Eigen::Vector2d(error[0], error[1]);
  return seen;
}

/// Homographies composed over a second drift by pixels, alike for all points: what most of them agree on
/// across the parallax is not their own motion.
void PointPaths::registerSamples() {
  HomographyFlowFit fit(size_);
  const size_t stride = std::max<size_t>(1, paths_.size() / kRegistrationPoints);
  const auto variance = static_cast<float>(std::pow(kRegistrationNoise_px / scale_, 2));
  for (size_t j = 0; j < samples_.size(); ++j) {
    Sample& sample = samples_[j];
    if (!camera_.remembers(sample.frame)) continue;
    fit.clear();
    for (size_t i = 0; i < paths_.size(); i += stride) {
      const PointPath& path = paths_[i];
      if (path.sampled <= j) continue;
      const CameraPath::Sighting seen = camera_.project(sample.frame, path.samples[j]);
      const Eigen::Vector2f moved = (path.at - seen.base).cast<float>();
      const cv::Vec2f pixel(static_cast<float>(seen.base.x()), static_cast<float>(seen.base.y()));
      const double length = seen.parallax.norm();
      if (length < kLeastParallax_px / scale_) {
        fit.add(pixel, {1, 0}, moved.x(), variance);
        fit.add(pixel, {0, 1}, moved.y(), variance);
      } else {
        const Eigen::Vector2f along = (seen.parallax / length).cast<float>();
        fit.add(pixel, {-along.y(), along.x()}, along.x() * moved.y() - along.y() * moved.x(), variance);
      }
    }
    sample.error = fit.solve(kRegistrationExpected_px / static_cast<float>(scale_), kRegistrationIterations);
  }
}

void PointPaths::test(PointPath& path, const Symmetric2f& tensor) {
  path.static_residual = path.moving_residual = path.log_likelihood = 0;
  const size_t count = std::min(path.sampled, samples_.size());
  if (count < kFewestSamples) return;
  const Eigen::Matrix2d whitening = whiteningOf(tensor, kNoise_px / scale_);
  UniformPathFit sightings;
  sightings.add({0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()});
  for (size_t j = 0; j < count && camera_.remembers(samples_[j].frame); ++j) {
    CameraPath::Sighting seen = sighting(samples_[j], path.samples[j]);
    seen.base -= path.at;
    sightings.add(seen);
  }
  if (sightings.size() <= kFewestSamples) return;
  const PathFit fit = sightings.solve(whitening, direction_error_);
  const auto number = static_cast<double>(sightings.size());
  path.static_residual = std::sqrt(fit.static_chi2 / number);
  path.moving_residual = std::sqrt(fit.moving_chi2 / number);
  path.log_likelihood = 0.5 * (fit.static_chi2 - fit.moving_chi2) / kCorrelatedSamples;
}

/// At the best texture of each cell that holds no point.
void PointPaths::begin(const cv::Mat1b& excluded) {
  paths_.reserve(paths_.size() + texture_.best().size());
  for (const cv::Point& at : texture_.best()) {
    if (!isInside({at.x, at.y}) || isExcluded(excluded, at)) continue;
    PointPath path;
    path.at = {at.x, at.y};
    path.samples.fill(Eigen::Vector2d::Zero());
    paths_.push_back(path);
  }
}

void PointPaths::sample() {
  since_sample_s_ = 0;
  samples_.push_front({camera_.current(), HomographyFlow(size_)});
  if (samples_.size() > PointPath::kMostSamples) samples_.pop_back();
  for (PointPath& path : paths_) {
    std::copy_backward(path.samples.begin(), path.samples.end() - 1, path.samples.end());
    path.samples[0] = path.at;
    path.sampled = std::min(path.sampled + 1, PointPath::kMostSamples);
  }
}

}  // namespace redbee
