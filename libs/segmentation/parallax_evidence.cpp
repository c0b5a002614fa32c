#include "segmentation/parallax_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "segmentation/guided_filter.hpp"
#include "segmentation/interval_difference.hpp"
#include "segmentation/parallax_segment.hpp"

namespace redbee {
namespace {

constexpr int kRegistrationReach = 1;  // px of the work: how badly a static pixel may be registered
constexpr double kMarginPx = 16;       // full-size px: flow so near to what is not there is made up

Eigen::Matrix3d toWork(double scale) {
  // A pixel of the work is the mean of a block: its centre lies between theirs.
  const double shift = -(scale - 1) / (2 * scale);
  Eigen::Matrix3d work;
  work << 1 / scale, 0, shift, 0, 1 / scale, shift, 0, 0, 1;
  return work;
}

}  // namespace

cv::Ptr<cv::DISOpticalFlow> makeMotionFlow(int work_downscale) {
  // Patches of 8 px at half the full size: a finer flow costs four times as much, a coarser one loses people.
  constexpr int kIterations = 4;
  constexpr int kStride = 5;
  auto dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST);
  dis->setFinestScale(work_downscale == 1 ? 1 : 0);
  dis->setGradientDescentIterations(kIterations);
  dis->setPatchStride(kStride);
  return dis;
}

ParallaxEvidence::ParallaxEvidence(const SegmentationParameters& parameters)
    : parameters_(parameters),
      scale_(std::max(parameters.work_downscale, 1)),
      work_(toWork(scale_)),
      dis_(makeMotionFlow(parameters.work_downscale)),
      travelling_(parameters) {}

void ParallaxEvidence::reset() {
  frames_.reset();
  travelling_.reset();
  unseen_.release();
}

void ParallaxEvidence::carry(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion) {
  last_step_ = normaliseHomography(work_ * ground * work_.inverse());
  frames_.carry(last_step_, motion);
}

cv::Mat ParallaxEvidence::learn(int64_t utime, const cv::Mat& grey, const Eigen::Matrix3d& K) {
  cv::Mat small;
  cv::resize(grey, small, {}, 1 / scale_, 1 / scale_, cv::INTER_AREA);
  cv::Mat found;
  if (frames_.newest() != nullptr) {
    cv::resize(evidence(small, work_ * K, utime), found, grey.size(), 0, 0, cv::INTER_LINEAR);
    cv::resize(unseen_, unseen_, grey.size(), 0, 0, cv::INTER_NEAREST);
  }
  if (small.data == grey.data) small = grey.clone();
  frames_.remember(utime, small, std::max(parameters_.appearance_span_s, parameters_.baseline_s));
  return found;
}

cv::Mat ParallaxEvidence::evidence(const cv::Mat& grey, const Eigen::Matrix3d& K, int64_t utime) {
  const EarlierFrame& frame = *frames_.aged(utime, parameters_.baseline_s);
  const int margin = static_cast<int>(std::lround(kMarginPx / scale_));
  const AlignedPicture reference = alignPicture(frame, K, margin);
  unseen_ = reference.unseen;
  cv::Mat flow;
  dis_->calc(grey, reference.grey, flow);
  const double frames =
      static_cast<double>(utime - frame.utime) / static_cast<double>(utime - frames_.newest()->utime);
  FlowVerdict verdict = judgeFlow(frame, K, grey, flow, frames);
  verdict.evidence.off.setTo(cv::Scalar::all(0), unseen_);
  verdict.evidence.appearance = unlikeStatic(grey, K, utime, reference, verdict.static_displaced);
  travelling_.update(verdict.evidence, last_step_, unseen_);
  const int radius = std::max(1, static_cast<int>(std::lround(parameters_.fill_radius_px / scale_)));
  const cv::Mat motion = guidedFilter(grey, travelling_.motion(), radius, parameters_.fill_contrast);
  cv::Mat product = cv::max(motion, 0);
  if (parameters_.use_appearance) product = product.mul(travelling_.appearance());
  cv::sqrt(product, product);
  return cv::min(product, 1);
}

cv::Mat ParallaxEvidence::flowVariance(const cv::Mat& grey) const {
  // At a quarter of the full size, about the flow's own grid. OpenCV's eigenvalue is that of the sum of
  // squared Sobel responses over kBlock^2 pixels, scaled by (kSobelGain / 2 * kBlock * 255)^-2.
  constexpr int kBlock = 5;
  constexpr double kSobelGain = 8;
  const double to_square_gradient = std::pow(kSobelGain / 2 * kBlock * 255 / (kBlock * kSobelGain), 2);
  cv::Mat quarter, variance;
  cv::resize(grey, quarter, {}, scale_ / 4, scale_ / 4, cv::INTER_AREA);
  cv::cornerMinEigenVal(quarter, variance, kBlock);
  const double noise2 = std::pow(parameters_.parallax_noise_px / scale_, 2);
  const double floor2 = parameters_.min_gradient * parameters_.min_gradient;
  variance = noise2 + noise2 * floor2 / (variance * to_square_gradient + 1e-3);
  cv::resize(variance, variance, grey.size(), 0, 0, cv::INTER_LINEAR);
  return variance;
}

ParallaxEvidence::FlowVerdict ParallaxEvidence::judgeFlow(const EarlierFrame& frame, const Eigen::Matrix3d& K,
                                                          const cv::Mat& grey, const cv::Mat& flow,
                                                          double frames) const {
  const ParallaxSegment segment(frame.motion, K, parameters_);
  const cv::Mat variance = flowVariance(grey);
  const auto share = static_cast<float>(1 / frames);
  FlowVerdict verdict{{cv::Mat(flow.size(), CV_32FC2), flow * share, {}}, cv::Mat(flow.size(), CV_32FC2)};
  for (int y = 0; y < flow.rows; ++y) {
    const cv::Vec2f* back = flow.ptr<cv::Vec2f>(y);
    const float* noise = variance.ptr<float>(y);
    cv::Vec2f* off = verdict.evidence.off.ptr<cv::Vec2f>(y);
    cv::Vec2f* displaced = verdict.static_displaced.ptr<cv::Vec2f>(y);
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const ParallaxSegment::Verdict judged = segment.judge(pixel + back[x], -back[x], noise[x]);
      off[x] = judged.off_in_sigmas;
      displaced[x] = judged.nearest;
    }
  }
  return verdict;
}

cv::Mat ParallaxEvidence::unlikeStatic(const cv::Mat& grey, const Eigen::Matrix3d& K, int64_t utime,
                                       const AlignedPicture& reference,
                                       const cv::Mat& static_displaced) const {
  // The static scene as ground, and at the depth that the flow suggests.
  const auto likeNeither = [&](const AlignedPicture& aligned, double age_ratio) {
    const GreyInterval interval(aligned.grey, kRegistrationReach);
    cv::Mat source(grey.size(), CV_32FC2);
    const auto ratio = static_cast<float>(age_ratio);
    for (int y = 0; y < source.rows; ++y) {
      const cv::Vec2f* displaced = static_displaced.ptr<cv::Vec2f>(y);
      cv::Vec2f* to = source.ptr<cv::Vec2f>(y);
      for (int x = 0; x < source.cols; ++x) {
        to[x] = cv::Vec2f(static_cast<float>(x), static_cast<float>(y)) - ratio * displaced[x];
      }
    }
    cv::Mat difference = cv::min(interval.outside(grey), interval.at(source).outside(grey));
    difference.setTo(0, aligned.unseen);
    return difference;
  };
  const auto unlikeGround = [&](const AlignedPicture& aligned) {
    cv::Mat difference = GreyInterval(aligned.grey, kRegistrationReach).outside(grey);
    difference.setTo(0, aligned.unseen);
    return difference;
  };
  const auto aligned = [&](double age_s) { return alignPicture(*frames_.aged(utime, age_s), K, 1); };

  constexpr double kStep = 2;
  double age = kStep * parameters_.baseline_s;
  AlignedPicture older = aligned(age);
  cv::Mat difference = cv::min(likeNeither(reference, 1), likeNeither(older, kStep));
  // Slow movers take long to leave their own place: the further pairs ask about the ground alone, for what
  // the flow says of a depth does not reach so far back.
  cv::Mat before = unlikeGround(older);
  while (kStep * age <= parameters_.appearance_span_s) {
    age *= kStep;
    const cv::Mat now = unlikeGround(aligned(age));
    difference = cv::max(difference, cv::min(before, now));
    before = now;
  }
  return differenceEvidence(difference, parameters_.silhouette_window_px, parameters_.photometric_noise);
}

}  // namespace redbee
