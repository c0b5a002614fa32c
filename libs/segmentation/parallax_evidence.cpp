#include "segmentation/parallax_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "segmentation/parallax_segment.hpp"
#include "segmentation/photometric_test.hpp"
#include "segmentation/warping.hpp"

namespace redbee {
namespace {

PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba) {
  return {cb.R_ba * ba.R_ba, cb.R_ba * ba.t_ba + cb.t_ba, ba.m_a, ba.h_a};
}

/// Inverse search follows patches of 8 px: flow within a patch's width of what is not there is made up.
void growUnseen(cv::Mat& unseen) {
  constexpr int kPatch = 8;
  cv::rectangle(unseen, cv::Rect({}, unseen.size()), cv::Scalar(255), 1);
  cv::dilate(unseen, unseen, cv::getStructuringElement(cv::MORPH_RECT, {kPatch + 1, kPatch + 1}));
}

}  // namespace

ParallaxEvidence::ParallaxEvidence(const SegmentationParameters& parameters)
    : parameters_(parameters), dis_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST)) {}

void ParallaxEvidence::reset() {
  frames_.clear();
  accumulated_.release();
  unseen_.release();
}

void ParallaxEvidence::carry(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion) {
  last_step_ = ground;
  for (Frame& frame : frames_) {
    frame.ground = normaliseHomography(ground * frame.ground);
    if (frame.still) {
      frame.motion = motion;
    } else if (frame.motion && motion) {
      frame.motion = compose(*motion, *frame.motion);
    } else {
      frame.motion.reset();
    }
    frame.still = false;
  }
}

const ParallaxEvidence::Frame* ParallaxEvidence::reference(int64_t utime) const {
  const int64_t wanted = utime - std::llround(parameters_.baseline_s * 1e6);
  const Frame* best = nullptr;
  for (const Frame& frame : frames_) {
    if (best == nullptr || std::abs(frame.utime - wanted) < std::abs(best->utime - wanted)) best = &frame;
  }
  return best;
}

cv::Mat ParallaxEvidence::learn(int64_t utime, const cv::Mat& grey, const Eigen::Matrix3d& K) {
  cv::Mat evidence;
  if (const Frame* frame = reference(utime)) {
    const cv::Mat aligned = alignReference(*frame, K);
    const cv::Mat flow = denseFlow(grey, aligned);
    evidence = judgeFlow(*frame, K, flow, grey, aligned);
    evidence.setTo(0, unseen_);
    const double frames =
        static_cast<double>(utime - frame->utime) / static_cast<double>(utime - frames_.back().utime);
    evidence = accumulate(evidence, flow, 1 / frames);
    accumulated_ = evidence.clone();
  }
  remember(utime, grey);
  return evidence;
}

void ParallaxEvidence::remember(int64_t utime, const cv::Mat& grey) {
  const double kept = 1.5 * parameters_.baseline_s * 1e6;
  while (!frames_.empty() && static_cast<double>(utime - frames_.front().utime) > kept) frames_.pop_front();
  Frame frame;
  frame.utime = utime;
  frame.grey = grey.clone();
  frames_.push_back(frame);
}

cv::Mat ParallaxEvidence::denseFlow(const cv::Mat& now, const cv::Mat& then) {
  cv::Mat flow;
  if (parameters_.flow_downscale <= 1) {
    dis_->calc(now, then, flow);
    return flow;
  }
  const double shrink = 1.0 / parameters_.flow_downscale;
  cv::Mat small_now, small_then;
  cv::resize(now, small_now, {}, shrink, shrink, cv::INTER_AREA);
  cv::resize(then, small_then, {}, shrink, shrink, cv::INTER_AREA);
  dis_->calc(small_now, small_then, flow);
  cv::resize(flow, flow, now.size(), 0, 0, cv::INTER_LINEAR);
  return flow * parameters_.flow_downscale;
}

cv::Mat ParallaxEvidence::alignReference(const Frame& frame, const Eigen::Matrix3d& K) {
  cv::Mat aligned = carryMap(frame.grey, frame.ground, cv::INTER_LINEAR);
  unseen_ = ~overlapMask(frame.grey.size(), frame.ground);
  if (!frame.motion) {
    growUnseen(unseen_);
    return aligned;
  }
  const Eigen::Matrix3d far = K * frame.motion->R_ba * K.inverse();
  const cv::Mat aligned_far = carryMap(frame.grey, far, cv::INTER_LINEAR);
  const cv::Mat unseen_far = ~overlapMask(frame.grey.size(), far);
  // Ground is where m' R' K^-1 x > 0: a linear function of the current pixel.
  const Eigen::RowVector3d horizon =
      frame.motion->m_a.transpose() * frame.motion->R_ba.transpose() * K.inverse();
  for (int y = 0; y < aligned.rows; ++y) {
    for (int x = 0; x < aligned.cols; ++x) {
      if (horizon.x() * x + horizon.y() * y + horizon.z() > 0) continue;
      aligned.at<uint8_t>(y, x) = aligned_far.at<uint8_t>(y, x);
      unseen_.at<uint8_t>(y, x) = unseen_far.at<uint8_t>(y, x);
    }
  }
  growUnseen(unseen_);
  return aligned;
}

cv::Mat ParallaxEvidence::judgeFlow(const Frame& frame, const Eigen::Matrix3d& K, const cv::Mat& flow,
                                    const cv::Mat& now, const cv::Mat& then) const {
  const ParallaxSegment segment(frame.motion, K, parameters_);
  const float half2 = static_cast<float>(parameters_.evidence_sigmas * parameters_.evidence_sigmas);
  cv::Mat evidence(flow.size(), CV_32F);
  cv::Mat static_source(flow.size(), CV_32FC2);
  cv::Mat moving_source(flow.size(), CV_32FC2);
  for (int y = 0; y < flow.rows; ++y) {
    const cv::Vec2f* back = flow.ptr<cv::Vec2f>(y);
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const cv::Vec2f ground = pixel + back[x];
      const ParallaxSegment::Verdict verdict = segment.judge(ground, -back[x]);
      evidence.at<float>(y, x) = verdict.sigmas_squared / (verdict.sigmas_squared + half2);
      moving_source.at<cv::Vec2f>(y, x) = ground;
      static_source.at<cv::Vec2f>(y, x) = pixel - verdict.nearest;
    }
  }
  if (!parameters_.use_photometric) return evidence;
  cv::Mat as_static, as_moving;
  cv::remap(then, as_static, static_source, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::remap(then, as_moving, moving_source, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return evidence.mul(photometricWeight(now, as_static, as_moving, parameters_));
}

cv::Mat ParallaxEvidence::accumulate(const cv::Mat& evidence, const cv::Mat& flow, double share) const {
  if (accumulated_.empty() || parameters_.evidence_rate >= 1) return evidence;
  const Eigen::Matrix3f back = last_step_.inverse().cast<float>();
  const auto step = static_cast<float>(share);
  cv::Mat source(flow.size(), CV_32FC2);
  for (int y = 0; y < flow.rows; ++y) {
    const cv::Vec2f* f = flow.ptr<cv::Vec2f>(y);
    cv::Vec2f* to = source.ptr<cv::Vec2f>(y);
    for (int x = 0; x < flow.cols; ++x) {
      const float u = static_cast<float>(x) + step * f[x][0];
      const float v = static_cast<float>(y) + step * f[x][1];
      const Eigen::Vector3f p = back * Eigen::Vector3f(u, v, 1);
      to[x] = {p.x() / p.z(), p.y() / p.z()};
    }
  }
  cv::Mat summed;
  cv::remap(accumulated_, summed, source, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::addWeighted(summed, 1 - parameters_.evidence_rate, evidence, parameters_.evidence_rate, 0, summed);
  return summed;
}

}  // namespace redbee
