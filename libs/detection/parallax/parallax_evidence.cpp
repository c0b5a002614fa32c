#include "redbee/detection/parallax/parallax_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/border_structure.hpp"
#include "redbee/detection/parallax/fast_movers.hpp"
#include "redbee/detection/parallax/moving_points.hpp"
#include "redbee/detection/parallax/registration_error.hpp"
#include "redbee/imaging/guided_filter.hpp"
#include "redbee/imaging/resampled.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr double kExpectedErrorPx = 0.5;  // full-size px, of the registration of two frames
// As min_gradient, but of the flow that the registration and the epipole are fitted to: they average over
// the image, and look for outliers.
constexpr double kFitGradient = 1.6;

// At this speed an object moves by a whole flow patch within two frames, and the halos of the flow at
// occlusions are as wide.
constexpr double kFastPx = 8;  // full-size px a frame
constexpr int kKeptRows = 4;   // of the normalized residual: PropagatedEvidence asks for three

int halvings(int from_downscale, int to_downscale) {
  int times = 0;
  for (int downscale = std::max(from_downscale, 1); downscale < to_downscale; downscale *= 2) ++times;
  return times;
}

}  // namespace

InverseSearch makeMotionFlow(const ParallaxParameters& parameters) {
  InverseSearchParameters search;
  search.finest_scale = halvings(parameters.work_downscale, parameters.flow_downscale);
  return InverseSearch(search);
}

ParallaxEvidence::ParallaxEvidence(const ParallaxParameters& parameters)
    : parameters_(parameters),
      follows_points_(parameters.use_point_paths),
      scale_(std::max(parameters.work_downscale, 1)),
      work_(downscaling(scale_)),
      search_(makeMotionFlow(parameters)),
      propagated_(parameters),
      paths_(parameters) {}

void ParallaxEvidence::reset() {
  frames_.reset();
  epipole_.reset();
  propagated_.reset();
  paths_.reset();
  fast_ = false;
  unknown_.release();
  speed_.release();
  residual_.release();
  compared_.reset();
}

void ParallaxEvidence::followPoints(bool wanted) {
  const bool follows = wanted && parameters_.use_point_paths;
  if (follows != follows_points_) paths_.reset();
  follows_points_ = follows;
}

void ParallaxEvidence::propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                                 const std::optional<PlaneMotion>& motion) {
  const auto at_work = [&](const Eigen::Matrix3d& H) {
    return normaliseHomography(work_ * H * work_.inverse());
  };
  last_step_ = at_work(ground);
  paths_.propagate(last_step_, motion);
  frames_.propagate(last_step_, motion, front ? std::optional(at_work(*front)) : std::nullopt);
}

cv::Mat1f ParallaxEvidence::learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
                                  cv::Size full, const cv::Mat1b& own_parts, SpareMaps& spare) {
  cv::Mat1b small;
  own_parts_.release();
  if (!own_parts.empty()) cv::resize(own_parts, own_parts_, shrunkSize(full, scale_), 0, 0, cv::INTER_AREA);
  cv::resize(grey, small, shrunkSize(full, scale_), 0, 0, cv::INTER_AREA);
  cv::Mat1f found;
  compared_.reset();
  residual_.release();
  const EarlierFrame* frame = frames_.aged(time, fast_ ? 0 : parameters_.baseline_s);
  const EarlierFrame* newest = frames_.newest();
  if (frame != nullptr && newest != nullptr) {
    elapsed_s_ = seconds(time - newest->time);
    const double frames = seconds(time - frame->time) / elapsed_s_;
    found = evidence(*frame, small, work_ * K, frames, spare);
  }
  frames_.store(time, small, work_ * K, parameters_.baseline_s);
  if (follows_points_) paths_.update(time, small, work_ * K, own_parts_);
  return found;
}

cv::Mat1f ParallaxEvidence::movingRegion(const cv::Mat1f& difference) const {
  return redbee::movingRegion(movingPoints(paths_.paths(), scale_), difference, unknown_.size(), scale_);
}

/// Neither image shows the scene there.
void ParallaxEvidence::leaveOutOwnParts(const EarlierFrame& frame, const Eigen::Matrix3d& K) {
  if (own_parts_.empty()) return;
  EarlierFrame parts = frame;
  parts.grey = own_parts_;
  cv::Mat1b covered = alignImage(parts, K, 0).grey > 0;
  covered |= own_parts_ > 0;
  const int side = 2 * (search_.patch() / 2) + 1;
  cv::dilate(covered, covered, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  unknown_ |= covered;
}

FlowComparison ParallaxEvidence::comparison(const EarlierFrame& frame, const cv::Mat1b& grey,
                                            const cv::Mat1b& earlier, const Eigen::Matrix3d& K) {
  const cv::Mat2f& flow = search_.flow(grey, earlier);
  const FlowTexture texture(grey, scale_);
  const FlowCovariance fit_noise = texture.covariance({parameters_.noise_px, kFitGradient});
  ParallaxSegment segment(frame.motion, K, parameters_);
  HomographyFlow error = registration(flow, fit_noise, segment);
  bool is_direction_known = frame.motion && parameters_.use_epipolar;
  if (!frame.motion) {
    if (const auto estimated = segmentWithoutMotion(frame, K, flow, fit_noise, error)) {
      segment = *estimated;
      error = registration(flow, fit_noise, segment);
      is_direction_known = true;
    }
  }
  const FlowCovariance noise = texture.covariance({parameters_.noise_px, parameters_.min_gradient});
  return FlowComparison(grey, earlier, flow, noise, {segment, error, is_direction_known});
}

cv::Mat1f ParallaxEvidence::evidence(const EarlierFrame& frame, const cv::Mat1b& grey,
                                     const Eigen::Matrix3d& K, double frames, SpareMaps& spare) {
  // Within half a patch of unknown pixels the flow is extrapolated.
  const AlignedImage reference = alignImage(frame, K, search_.patch() / 2);
  unknown_ = reference.unknown;
  leaveOutOwnParts(frame, K);
  compared_.emplace(comparison(frame, grey, reference.grey, K));
  const cv::Mat2f& flow = compared_->flow();
  speed_.create(flow.size());
  residual_.create(flow.size());
  cv::Mat2f normalized(kKeptRows, flow.cols), nearest(1, flow.cols);
  FastMovers movers(parameters_.use_short_baseline, kFastPx / scale_ * frames);
  int compared = 0;
  const auto residual = [&](int y) {
    for (; compared <= y; ++compared) {
      cv::Vec2f* const row = normalized[compared % kKeptRows];
      compared_->compareRow(compared, unknown_[compared],
                            {row, nearest[0], residual_[compared], speed_[compared]});
      movers.count(compared, flow, unknown_, row);
    }
    return normalized[y % kKeptRows];
  };
  propagated_.update({residual, flow, static_cast<float>(1 / frames)}, last_step_, unknown_, spare);
  fast_ = movers.areMany();
  const int radius = std::max(1, static_cast<int>(std::lround(parameters_.fill_radius_px / scale_)));
  cv::Mat1f motion = guidedFilter(grey, propagated_.motion(), radius, parameters_.fill_contrast);
  motion = cv::min(cv::max(motion, 0), 1);
  if (!frame.motion && parameters_.border_stretch > 0) suppressBorderStructure(motion);
  return motion;
}

std::optional<ParallaxSegment> ParallaxEvidence::segmentWithoutMotion(const EarlierFrame& frame,
                                                                      const Eigen::Matrix3d& K,
                                                                      const cv::Mat2f& flow,
                                                                      const FlowCovariance& noise,
                                                                      const HomographyFlow& error) {
  if (parameters_.use_epipolar && parameters_.use_epipole) {
    const EpipoleInput input{flow, noise, unknown_, error, toMatx(frame.ground), toMatx(K), toMatx(frame.K)};
    if (const auto epipole = epipole_.update(input, elapsed_s_))
      return ParallaxSegment(*epipole, parameters_);
  }
  if (frame.front) return ParallaxSegment(frame.ground, *frame.front, parameters_);
  return std::nullopt;
}

cv::Mat1f ParallaxEvidence::photometricGain(const cv::Mat1f& foreground) {
  constexpr double kCompared = 0.1;  // objects begin above
  if (!compared_ || !compared_->isDirectionKnown() || parameters_.photometric_noise <= 0) return {};
  const cv::Mat1f at_work = resized(foreground, unknown_.size());
  return redbee::photometricGain(compared_->images(unknown_), at_work > kCompared,
                                 parameters_.photometric_noise);
}

void ParallaxEvidence::suppressBorderStructure(cv::Mat1f& motion) const {
  // Squared, because evidence at the border has not accumulated yet for objects that enter the image.
  const cv::Mat1f inside =
      1 - fractionOfBorderStructure(motion, unknown_, parameters_.border_stretch * motion.cols);
  motion = motion.mul(inside).mul(inside);
}

HomographyFlow ParallaxEvidence::registration(const cv::Mat2f& flow, const FlowCovariance& noise,
                                              const ParallaxSegment& segment) const {
  if (!parameters_.use_registration) return HomographyFlow(flow.size());
  return registrationError(flow, noise, unknown_, segment, static_cast<float>(kExpectedErrorPx / scale_));
}

}  // namespace redbee
