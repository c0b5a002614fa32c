#include "segmentation/foreground_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace redbee {

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
  // The IMU's translation drifts and is wrong until its filter has settled; the fused homography holds a
  // better.
  std::optional<PlaneMotion> consistent = motion;
  if (consistent) consistent->t_ba = translationFromHomography(K, ground, *motion);
  motion_.carry(ground, front, consistent);
  if (!parameters_.use_appearance) return;
  background_.carry(SceneMotion(normaliseHomography(to_background_ * ground * to_background_.inverse()),
                                motion, to_background_ * K));
}

cv::Mat ForegroundEvidence::pictureToCompare(const cv::Mat& grey, const cv::Mat& colour,
                                             cv::Size full) const {
  cv::Mat picture = colour;
  if (picture.empty()) cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  cv::Mat small;
  cv::resize(picture, small, shrunkSize(full, std::max(parameters_.background_downscale, 1)), 0, 0,
             cv::INTER_AREA);
  // The noise of single pixels and of JPEG's blocks.
  constexpr double kSigmaPx = 0.6;
  cv::GaussianBlur(small, small, {3, 3}, kSigmaPx);
  return small;
}

ForegroundEvidence::Verdict ForegroundEvidence::learn(int64_t utime, const cv::Mat& grey,
                                                      const cv::Mat& colour, const Eigen::Matrix3d& K,
                                                      cv::Size full) {
  const double elapsed_s = static_cast<double>(utime - last_utime_) * 1e-6;
  last_utime_ = utime;
  Verdict verdict;
  const cv::Mat motion = motion_.learn(utime, grey, K, full);
  if (!motion.empty()) {
    cv::sqrt(motion, verdict.foreground);
    cv::resize(motion_.unseen(), verdict.unseen, full, 0, 0, cv::INTER_NEAREST);
  }
  if (parameters_.use_appearance) {
    const cv::Mat picture = pictureToCompare(grey, colour, full);
    cv::Mat moving = cv::Mat::zeros(picture.size(), CV_32F);
    if (!motion.empty()) {
      cv::resize(verdict.foreground, verdict.foreground, picture.size(), 0, 0, cv::INTER_LINEAR);
      verdict.foreground = verdict.foreground.mul(background_.unlike(picture));
      // Half is sure enough: what is learned by mistake is lost for as long as the background remembers.
      moving = cv::min(2 * verdict.foreground, 1);
    }
    background_.learn(picture, moving, elapsed_s);
  }
  if (!motion.empty()) cv::resize(verdict.foreground, verdict.foreground, full, 0, 0, cv::INTER_LINEAR);
  return verdict;
}

}  // namespace redbee
