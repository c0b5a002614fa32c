#include "redbee/detection/parallax/parallax_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/parallax/border_structure.hpp"
#include "redbee/detection/parallax/registration_error.hpp"
#include "redbee/imaging/guided_filter.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr double kExpectedErrorPx = 0.5;  // full-size px, of the registration of two frames
// As min_gradient, but of the flow that the registration and the epipole are fitted to: they average over
// the image, and look for outliers.
constexpr double kFitGradient = 1.6;

int halvings(int from_downscale, int to_downscale) {
  int times = 0;
  for (int downscale = std::max(from_downscale, 1); downscale < to_downscale; downscale *= 2) ++times;
  return times;
}

/// Bounded, so that few pixels of a wild flow do not make the mean of many.
cv::Mat1f squaredLength(const cv::Mat2f& vectors) {
  constexpr float kMost = 100;
  cv::Mat1f squared(vectors.size());
  for (int y = 0; y < vectors.rows; ++y) {
    for (int x = 0; x < vectors.cols; ++x) {
      squared(y, x) = std::min(vectors(y, x).dot(vectors(y, x)), kMost);
    }
  }
  return squared;
}

}  // namespace

cv::Ptr<cv::DISOpticalFlow> makeMotionFlow(const ParallaxParameters& parameters) {
  constexpr int kIterations = 4;
  constexpr int kStride = 5;
  auto dis = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST);
  dis->setFinestScale(halvings(parameters.work_downscale, parameters.flow_downscale));
  dis->setGradientDescentIterations(kIterations);
  dis->setPatchStride(kStride);
  return dis;
}

ParallaxEvidence::ParallaxEvidence(const ParallaxParameters& parameters)
    : parameters_(parameters),
      scale_(std::max(parameters.work_downscale, 1)),
      work_(downscaling(scale_)),
      dis_(makeMotionFlow(parameters)),
      propagated_(parameters) {}

void ParallaxEvidence::reset() {
  frames_.reset();
  epipole_.reset();
  propagated_.reset();
  fast_ = false;
  unknown_.release();
  speed_.release();
  residual_.release();
  compared_.reset();
}

void ParallaxEvidence::propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                                 const std::optional<PlaneMotion>& motion) {
  const auto at_work = [&](const Eigen::Matrix3d& H) {
    return normaliseHomography(work_ * H * work_.inverse());
  };
  last_step_ = at_work(ground);
  frames_.propagate(last_step_, motion, front ? std::optional(at_work(*front)) : std::nullopt);
}

cv::Mat1f ParallaxEvidence::learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
                                  cv::Size full) {
  cv::Mat1b small;
  cv::resize(grey, small, shrunkSize(full, scale_), 0, 0, cv::INTER_AREA);
  cv::Mat1f found;
  compared_.reset();
  residual_.release();
  const EarlierFrame* frame = frames_.aged(time, fast_ ? 0 : parameters_.baseline_s);
  const EarlierFrame* newest = frames_.newest();
  if (frame != nullptr && newest != nullptr) {
    elapsed_s_ = seconds(time - newest->time);
    const double frames = seconds(time - frame->time) / elapsed_s_;
    found = evidence(*frame, small, work_ * K, frames);
  }
  frames_.store(time, small, parameters_.baseline_s);
  return found;
}

cv::Mat1f ParallaxEvidence::evidence(const EarlierFrame& frame, const cv::Mat1b& grey,
                                     const Eigen::Matrix3d& K, double frames) {
  // Within half a patch of unknown pixels the flow is extrapolated.
  const int margin = (dis_->getPatchSize() / 2) << dis_->getFinestScale();
  const AlignedImage reference = alignImage(frame, K, margin);
  unknown_ = reference.unknown;
  cv::Mat2f flow;
  dis_->calc(grey, reference.grey, flow);
  const FlowTexture texture(grey, scale_);
  const cv::Mat3f covariance = texture.covariance({parameters_.noise_px, parameters_.min_gradient});
  const cv::Mat1f variance = largestVariance(texture.covariance({parameters_.noise_px, kFitGradient}));
  ParallaxSegment segment(frame.motion, K, parameters_);
  HomographyFlow error = registration(flow, variance, segment);
  bool direction_known = frame.motion && parameters_.use_epipolar;
  if (!frame.motion) {
    if (const auto estimated = segmentWithoutMotion(frame, K, flow, variance, error)) {
      segment = *estimated;
      error = registration(flow, variance, segment);
      direction_known = true;
    }
  }
  cv::Mat2f nearest(flow.size());
  FrameEvidence now = frameEvidence(segment, error, covariance, flow, frames, nearest);
  if (direction_known && parameters_.photometric_noise > 0)
    compared_.emplace(ImagePair{grey, reference.grey, flow, nearest, error});
  fast_ = parameters_.use_short_baseline && hasFastMovers(flow, now.normalized_residual, frames);
  residual_ = squaredLength(now.normalized_residual);
  residual_.setTo(kNotCompared, unknown_);
  now.normalized_residual.setTo(cv::Scalar::all(0), unknown_);
  propagated_.update(now, last_step_, unknown_);
  const int radius = std::max(1, static_cast<int>(std::lround(parameters_.fill_radius_px / scale_)));
  cv::Mat1f motion = guidedFilter(grey, propagated_.motion(), radius, parameters_.fill_contrast);
  motion = cv::min(cv::max(motion, 0), 1);
  if (!frame.motion && parameters_.border_stretch > 0) suppressBorderStructure(motion);
  return motion;
}

std::optional<ParallaxSegment> ParallaxEvidence::segmentWithoutMotion(const EarlierFrame& frame,
                                                                      const Eigen::Matrix3d& K,
                                                                      const cv::Mat2f& flow,
                                                                      const cv::Mat1f& variance,
                                                                      const HomographyFlow& error) {
  if (parameters_.use_epipolar && parameters_.use_epipole) {
    const EpipoleInput input{flow, variance, unknown_, error, toMatx(frame.ground), toMatx(K)};
    if (const auto epipole = epipole_.update(input, elapsed_s_))
      return ParallaxSegment(*epipole, parameters_);
  }
  if (frame.front) return ParallaxSegment(frame.ground, *frame.front, parameters_);
  return std::nullopt;
}

cv::Mat1f ParallaxEvidence::photometricGain(const cv::Mat1f& foreground) const {
  constexpr double kCompared = 0.1;  // objects begin above
  if (!compared_) return {};
  cv::Mat1f at_work;
  cv::resize(foreground, at_work, unknown_.size(), 0, 0, cv::INTER_LINEAR);
  return redbee::photometricGain(*compared_, at_work > kCompared, parameters_.photometric_noise);
}

bool ParallaxEvidence::hasFastMovers(const cv::Mat2f& flow, const cv::Mat2f& normalized_residual,
                                     double frames) const {
  // At this speed an object moves by a whole flow patch within two frames, and the halos of the flow at
  // occlusions are as wide.
  constexpr double kFastPx = 8;  // full-size px a frame
  constexpr float kSureSigmas = 3;
  constexpr int kStep = 8;
  constexpr double kFraction = 0.02;  // of the image
  const auto fast = static_cast<float>(kFastPx / scale_ * frames);
  int known = 0, fast_movers = 0;
  for (int y = kStep / 2; y < flow.rows; y += kStep) {
    for (int x = kStep / 2; x < flow.cols; x += kStep) {
      if (unknown_(y, x) != 0) continue;
      ++known;
      const bool moves = cv::norm(normalized_residual(y, x)) > kSureSigmas;
      if (moves && cv::norm(flow(y, x)) > fast) ++fast_movers;
    }
  }
  return fast_movers > kFraction * known;
}

void ParallaxEvidence::suppressBorderStructure(cv::Mat1f& motion) const {
  // Squared, because evidence at the border has not accumulated yet for objects that enter the image.
  const cv::Mat1f inside =
      1 - fractionOfBorderStructure(motion, unknown_, parameters_.border_stretch * motion.cols);
  motion = motion.mul(inside).mul(inside);
}

HomographyFlow ParallaxEvidence::registration(const cv::Mat2f& flow, const cv::Mat1f& variance,
                                              const ParallaxSegment& segment) const {
  if (!parameters_.use_registration) return HomographyFlow(flow.size());
  return registrationError(flow, variance, unknown_, segment, static_cast<float>(kExpectedErrorPx / scale_));
}

FrameEvidence ParallaxEvidence::frameEvidence(const ParallaxSegment& segment, const HomographyFlow& error,
                                              const cv::Mat3f& covariance, const cv::Mat2f& flow,
                                              double frames, cv::Mat2f& nearest) {
  FrameEvidence evidence{cv::Mat2f(flow.size()), flow * (1 / frames)};
  speed_.create(flow.size());
  for (int y = 0; y < flow.rows; ++y) {
    const cv::Vec2f* back = flow[y];
    const Symmetric2f* noise = covariance[y];
    cv::Vec2f* residual = evidence.normalized_residual[y];
    cv::Vec2f* speed = speed_[y];
    cv::Vec2f* at = nearest[y];
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const cv::Vec2f forth = -back[x] - error.at(pixel[0], pixel[1]);
      const ParallaxSegment::Residual found = segment.residual(pixel + back[x], forth, noise[x]);
      residual[x] = found.normalized_residual;
      at[x] = found.nearest;
      speed[x] = {std::sqrt(forth.dot(forth)), largestVariance(noise[x])};
    }
  }
  return evidence;
}

}  // namespace redbee
