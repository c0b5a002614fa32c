#include "redbee/detection/parallax/foreground_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/grey_reconstruction.hpp"
#include "redbee/imaging/guided_filter.hpp"

namespace redbee {
namespace {

constexpr double kUnknownVariance = 1e6;  // px^2, of the speed of what no earlier frame shows

}  // namespace

ForegroundEvidence::ForegroundEvidence(const SegmentationParameters& parameters)
    : parameters_(parameters),
      to_background_(downscaling(std::max(parameters.background_downscale, 1))),
      motion_(parameters),
      background_(parameters) {}

void ForegroundEvidence::reset() {
  motion_.reset();
  background_.reset();
}

void ForegroundEvidence::carry(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                               const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K) {
  // The IMU's translation drifts and is wrong until its filter has converged; the fused homography gives a
  // better one.
  std::optional<PlaneMotion> consistent = motion;
  if (consistent) consistent->t_ba = translationFromHomography(K, ground, *motion);
  motion_.carry(ground, front, consistent);
  if (!parameters_.use_appearance) return;
  background_.carry(SceneMotion(normaliseHomography(to_background_ * ground * to_background_.inverse()),
                                motion, to_background_ * K));
}

cv::Mat ForegroundEvidence::imageToCompare(const cv::Mat& grey, const cv::Mat& colour, cv::Size full) const {
  cv::Mat image = colour;
  if (image.empty()) cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  cv::Mat small;
  cv::resize(image, small, shrunkSize(full, std::max(parameters_.background_downscale, 1)), 0, 0,
             cv::INTER_AREA);
  // The noise of single pixels and of JPEG's blocks.
  constexpr double kSigmaPx = 0.6;
  cv::GaussianBlur(small, small, {3, 3}, kSigmaPx);
  cv::cvtColor(small, small, cv::COLOR_BGR2BGRA);
  small.convertTo(small, CV_32F);
  return small;
}

/// Pixels of one region move together: each takes half of its evidence from similar pixels around it.
void ForegroundEvidence::fillRegions(const cv::Mat& image, cv::Mat& foreground) const {
  const double scale = std::max(parameters_.background_downscale, 1);
  const int radius = std::max(1, static_cast<int>(std::lround(parameters_.region_radius_px / scale)));
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  foreground = 0.5 * (foreground + guidedFilter(grey, foreground, radius, parameters_.fill_contrast));
  foreground = cv::min(cv::max(foreground, 0), 1);
}

ForegroundEvidence::Verdict ForegroundEvidence::learn(int64_t utime, const cv::Mat& grey,
                                                      const cv::Mat& colour, const Eigen::Matrix3d& K,
                                                      cv::Size full) {
  const double elapsed_s = static_cast<double>(utime - last_utime_) * 1e-6;
  last_utime_ = utime;
  const cv::Mat motion = motion_.learn(utime, grey, K, full);
  cv::Mat foreground;
  if (!motion.empty()) foreground = motion / (motion + parameters_.motion_half);
  if (parameters_.use_appearance) {
    const cv::Mat image = imageToCompare(grey, colour, full);
    cv::Mat moving = cv::Mat::zeros(image.size(), CV_32F);
    SurfaceSpeed speed(image.size(), CV_32FC2, cv::Scalar(0, kUnknownVariance));
    if (!motion.empty()) {
      cv::resize(motion_.speed(), speed, image.size(), 0, 0, cv::INTER_LINEAR);
      cv::resize(foreground, foreground, image.size(), 0, 0, cv::INTER_LINEAR);
      cv::Mat foreign = foreground.mul(background_.appearanceDifference(image, speed));
      if (parameters_.use_hole_filling) {
        const double gap_px = parameters_.outline_gap_px / std::max(parameters_.background_downscale, 1);
        foreign = cv::min(fillHoles(foreign, static_cast<int>(std::lround(gap_px))), foreground);
      }
      foreground = foreign;
      if (parameters_.region_radius_px > 0) fillRegions(image, foreground);
      // Half is enough: an object learned by mistake is missed for the background's whole span.
      moving = cv::min(2 * foreground, 1);
    }
    background_.learn(image, moving, speed, elapsed_s);
  }
  Verdict verdict;
  if (motion.empty()) return verdict;
  cv::resize(motion_.unseen(), verdict.unseen, full, 0, 0, cv::INTER_NEAREST);
  foreground.convertTo(verdict.foreground, CV_8U, 255);
  cv::resize(verdict.foreground, verdict.foreground, full, 0, 0, cv::INTER_LINEAR);
  return verdict;
}

}  // namespace redbee
