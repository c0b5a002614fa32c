#include "redbee/detection/parallax/foreground_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/objects/candidates.hpp"
#include "redbee/imaging/enlarged.hpp"
#include "redbee/imaging/grey_reconstruction.hpp"
#include "redbee/imaging/guided_filter.hpp"
#include "redbee/imaging/repeated_pixels.hpp"
#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

constexpr float kUnknownVariance = 1e6F;  // px^2, of the speed where it is unknown

bool usesCandidates(const ParallaxParameters& parallax, const AppearanceParameters& appearance) {
  const bool is_one_size = std::max(appearance.downscale, 1) == std::max(parallax.work_downscale, 1);
  return appearance.enabled && appearance.use_candidates && is_one_size;
}

/// Beside candidates points find next to nothing (EXPERIMENTS.md), for a seventh of the work.
ParallaxParameters withoutNeedlessPoints(ParallaxParameters parallax,
                                         const AppearanceParameters& appearance) {
  if (usesCandidates(parallax, appearance)) parallax.use_point_paths = false;
  return parallax;
}

/// x / (x + half) of each value x, in place.
void overSumWith(float half, cv::Mat1f& map) {
  for (int y = 0; y < map.rows; ++y) {
    float* const row = map[y];
    for (int x = 0; x < map.cols; ++x) row[x] = row[x] / (row[x] + half);
  }
}

}  // namespace

ForegroundEvidence::ForegroundEvidence(const ParallaxParameters& parallax,
                                       const AppearanceParameters& appearance, const ShadowParameters& shadow)
    : parallax_(withoutNeedlessPoints(parallax, appearance)),
      appearance_(appearance),
      downscale_(std::max(appearance.downscale, 1)),
      to_background_(downscaling(downscale_)),
      motion_(parallax_),
      background_(appearance, shadow, parallax.evidence_sigmas) {
  if (usesCandidates(parallax, appearance)) {
    ground_.emplace();
    objectTrees();  // read now, rather than in a frame
  }
}

void ForegroundEvidence::reset() {
  motion_.reset();
  background_.reset();
  if (ground_) ground_->reset();
  spare_.clear();
}

void ForegroundEvidence::propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                                   const std::optional<PlaneMotion>& motion, const CameraPair& cameras) {
  // The IMU's translation drifts and is wrong until its filter has converged; the fused homography gives a
  // better one.
  std::optional<PlaneMotion> consistent = motion;
  if (consistent) consistent->t_ba = translationFromHomography(cameras, ground, *motion);
  motion_.propagate(ground, front, consistent);
  if (!appearance_.enabled) return;
  const Eigen::Matrix3d small = normaliseHomography(to_background_ * ground * to_background_.inverse());
  background_.propagate(
      SceneMotion(small, motion, {to_background_ * cameras.K_a, to_background_ * cameras.K_b}), spare_);
  if (ground_) ground_->propagate(small, consistent);
}

cv::Mat4b ForegroundEvidence::imageToCompare(const cv::Mat1b& grey, const cv::Mat3b& colour,
                                             cv::Size full) const {
  cv::Mat3b image = colour;
  if (image.empty()) cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  if (const cv::Size size = shrunkSize(full, downscale_); image.size() != size) {
    cv::resize(image, image, size, 0, 0, cv::INTER_AREA);
  }
  // Suppresses the noise of single pixels and of JPEG blocks.
  constexpr double kSigmaPx = 0.6;
  cv::Mat3b small;
  cv::GaussianBlur(image, small, {3, 3}, kSigmaPx);
  cv::Mat4b with_fourth;
  cv::cvtColor(small, with_fourth, cv::COLOR_BGR2BGRA);
  return with_fourth;
}

/// Pixels of one region move together: half of each pixel's P_FG is taken from similar pixels around it.
void ForegroundEvidence::fillRegions(const cv::Mat4b& image, cv::Mat1f& foreground) const {
  const double scale = downscale_;
  const int radius = std::max(1, static_cast<int>(std::lround(parallax_.region_radius_px / scale)));
  constexpr int kTogether = 16;  // rows
  cv::Mat1f grey(image.size());
  cv::Mat4f rows;
  for (int y = 0; y < image.rows; y += kTogether) {
    const cv::Range range(y, std::min(y + kTogether, image.rows));
    image.rowRange(range).convertTo(rows, CV_32F);
    cv::cvtColor(rows, grey.rowRange(range), cv::COLOR_BGRA2GRAY);
  }
  foreground = 0.5 * (foreground + guidedFilter(grey, foreground, radius, parallax_.fill_contrast));
  foreground = cv::min(cv::max(foreground, 0), 1);
}

/// What the background model knows of the flow: foreground before its appearance counts, and the surfaces'
/// speed.
void ForegroundEvidence::resizeToBackground(cv::Mat1f& foreground, SurfaceSpeed& speed, cv::Size size) const {
  speed = motion_.speed();
  if (speed.size() == size) return;
  cv::resize(motion_.speed(), speed, size, 0, 0, cv::INTER_LINEAR);
  cv::resize(foreground, foreground, size, 0, 0, cv::INTER_LINEAR);
}

ForegroundMaps ForegroundEvidence::learn(CameraTime time, const cv::Mat1b& grey, const cv::Mat3b& colour,
                                         const Eigen::Matrix3d& K, cv::Size full,
                                         const cv::Mat1b& own_parts) {
  const double elapsed_s = seconds(time - last_time_);
  last_time_ = time;
  cv::Mat1f foreground = motion_.learn(time, grey, K, full, own_parts, spare_), around_points;
  ForegroundMaps maps;
  const bool is_first = foreground.empty();
  if (ground_) {
    maps.ground = ground_->learn(time, motion_.image(), to_background_ * K);
    maps.complete_ground = [this](const cv::Rect& part) { ground_->complete(part); };
  }
  overSumWith(static_cast<float>(parallax_.motion_half), foreground);
  if (appearance_.enabled) {
    const cv::Mat4b image = imageToCompare(grey, colour, full);
    cv::Mat1f moving;
    SurfaceSpeed speed;
    if (is_first) {
      moving = cv::Mat1f::zeros(image.size());
      speed = SurfaceSpeed(image.size(), cv::Vec2f(0, kUnknownVariance));
    } else {
      resizeToBackground(foreground, speed, image.size());
      cv::Mat1f foreign = background_.appearanceDifference(image, speed);
      around_points = motion_.movingRegion(foreign);
      if (ground_) {
        maps.colours = image;
        foreign.convertTo(maps.appearance, CV_8U, 255);
        foreground.convertTo(maps.motion, CV_8U, 255);
      }
      cv::multiply(foreign, foreground, foreign);
      if (parallax_.use_hole_filling && is_complete_) {
        const double gap_px = parallax_.outline_gap_px / downscale_;
        fillHoles(foreign, static_cast<int>(std::lround(gap_px)));
        foreign = cv::min(foreign, foreground);
      }
      foreground = foreign;
      foreign.release();
      if (parallax_.region_radius_px > 0 && is_complete_) fillRegions(image, foreground);
      // Half is enough: an object learned as background would be missed for the model's whole span.
      moving = cv::min(2 * foreground, 1);
      if (!around_points.empty()) {
        const cv::Mat1f small_movers = resized(around_points, moving.size());
        moving = cv::max(moving, cv::min(2 * small_movers, 1));
      }
    }
    if (!own_parts.empty()) {  // the background behind them stays what it was
      cv::Mat1b covered;
      cv::resize(own_parts, covered, image.size(), 0, 0, cv::INTER_NEAREST);
      moving.setTo(1, covered);
    }
    background_.learn(image, moving, speed, elapsed_s);
  }
  if (is_first) return maps;
  maps.gain = motion_.photometricGain(foreground);
  maps.residual = motion_.residual();
  maps.moving = around_points;
  maps.unknown = repeatedPixels(motion_.unknown(), full);
  foreground.convertTo(maps.foreground, CV_8U, 255);
  maps.foreground = enlarged(maps.foreground, full);
  return maps;
}

}  // namespace redbee
