#include "redbee/visual/visual_homography.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "redbee/geometry/products.hpp"
#include "redbee/imaging/repeated_image.hpp"
#include "redbee/visual/sharpness.hpp"

namespace redbee {
namespace {

/// Fraction of all tracks that a plane must explain to be accepted against the prediction, and how many times
/// the inliers of the predicted plane.
constexpr double kContradiction = 0.6;
constexpr double kOverwhelming = 2.0;
/// A rotation in wrong units or axes leads every search astray, and vision would never find what contradicts
/// it.
constexpr int kMostFailures = 5;
/// Long enough for the contradiction to be noticed (inertial/vision_agreement.hpp).
constexpr Duration kWithoutPrediction = std::chrono::seconds(2);

}  // namespace

const char* toString(VisualStatus status) {
  switch (status) {
    case VisualStatus::kGood:
      return "good";
    case VisualStatus::kFirstFrame:
      return "first frame";
    case VisualStatus::kNoTexture:
      return "no texture";
    case VisualStatus::kNoPlane:
      return "no plane";
    case VisualStatus::kRepeated:
      return "the image repeats the one before";
  }
  return "unknown";
}

HomographyPrediction compose(const HomographyPrediction& later, const HomographyPrediction& earlier,
                             const ImageScaling& scaling) {
  const auto J = composeJacobians(scaling.scale(later.H), scaling.scale(earlier.H));
  return {normaliseHomography(later.H * earlier.H),
          mappedCovariance(J.by_left, later.covariance) + mappedCovariance(J.by_right, earlier.covariance)};
}

VisualHomographyEstimator::VisualHomographyEstimator(const VisualParameters& parameters,
                                                     const cv::Mat1b& unknown)
    : parameters_(parameters), tracker_(parameters.tracker, unknown) {}

void VisualHomographyEstimator::resetReference() {
  tracker_.reset();
  previous_time_.reset();
  reference_half_.release();
  reference_sharpness_ = 0;
}

void VisualHomographyEstimator::setReference(CameraTime time, const cv::Mat1b& half, cv::Size size,
                                             double sharpness) {
  previous_time_ = time;
  reference_half_ = half;
  size_ = size;
  reference_sharpness_ = sharpness;
}

/// Without a prediction an image that does not move is as good as any: its homography is the identity.
bool VisualHomographyEstimator::isRepeated(CameraTime time, const cv::Mat1b& half,
                                           const std::optional<Eigen::Matrix3d>& predicted) const {
  constexpr double kMoved_px = 0.5;
  if (!predicted || time - *previous_time_ > kMaxRepetition) return false;
  const double moved = meanTransferError(*predicted, Eigen::Matrix3d::Identity(), size_.width, size_.height);
  return moved > kMoved_px && repeats(half, reference_half_, 2);
}

bool VisualHomographyEstimator::lacksTexture(const Pyramid& image, double sharpness) const {
  if (sharpness < parameters_.min_sharpness) return true;
  if (sharpness < parameters_.min_sharpness_fraction * reference_sharpness_) return true;
  return !tracker_.hasTexture(image, parameters_.ransac.min_inliers);
}

std::optional<HomographyEstimate> VisualHomographyEstimator::estimateGround(
    const PointTracks& tracks, const std::optional<HomographyPrediction>& prediction) const {
  RansacParameters ransac = parameters_.ransac;
  if (!prediction) return estimateHomography(tracks, size_.width, size_.height, ransac);
  auto near = estimateHomographyNear(tracks, size_.width, size_.height, prediction->H, prediction->covariance,
                                     ransac);
  const auto all = static_cast<double>(tracks.previous.size());
  if (near && near->inliers >= kContradiction * all) return near;
  // A plane that contradicts the prediction is accepted only when it explains most of the image: then the
  // prediction is wrong, and the few points near it are coincidental.
  ransac.min_inlier_ratio = std::max(ransac.min_inlier_ratio, kContradiction);
  auto largest = estimateHomography(tracks, size_.width, size_.height, ransac);
  if (near && (!largest || largest->inliers < kOverwhelming * near->inliers)) return near;
  return largest;
}

void VisualHomographyEstimator::noteOutcome(bool predicted, bool found) {
  if (predicted) failures_ = found ? 0 : failures_ + 1;
  if (failures_ < kMostFailures) return;
  failures_ = 0;
  unpredicted_until_ = *previous_time_ + kWithoutPrediction;
}

VisualHomography VisualHomographyEstimator::step(CameraTime time, const cv::Mat1b& grey,
                                                 const std::optional<HomographyPrediction>& prediction) {
  if (grey.empty()) throw std::invalid_argument("the visual stage needs an image");
  VisualHomography result;
  result.time = time;
  const bool connected = previous_time_ && time > *previous_time_ &&
                         (time - *previous_time_).count() <= 1e6 * parameters_.max_frame_gap_s &&
                         grey.size() == size_;
  if (!connected) resetReference();
  result.time_previous = previous_time_.value_or(time);

  Pyramid image = tracker_.pyramidOf(grey);
  const cv::Mat1b half = image.size() > 1 ? image[1].image() : cv::Mat1b();
  const double sharpness = sharpnessOf(half);
  if (lacksTexture(image, sharpness)) {
    result.status = VisualStatus::kNoTexture;
    return result;
  }
  // The clock may have been set back meanwhile.
  const bool is_ignored = connected && unpredicted_until_ && time < *unpredicted_until_ &&
                          time >= *unpredicted_until_ - kWithoutPrediction;
  const std::optional<Eigen::Matrix3d> guess =
      prediction && prediction->H.allFinite() && !is_ignored ? std::optional(prediction->H) : std::nullopt;
  if (connected && isRepeated(time, half, guess)) {
    result.status = VisualStatus::kRepeated;
    return result;
  }
  result.tracks = tracker_.advance(std::move(image), guess);
  setReference(time, half, grey.size(), sharpness);
  if (!connected) return result;

  if (static_cast<int>(result.tracks.previous.size()) < parameters_.ransac.min_inliers) {
    result.status = VisualStatus::kNoTexture;
    noteOutcome(guess.has_value(), false);
    return result;
  }
  result.ground = estimateGround(result.tracks, guess ? prediction : std::nullopt);
  result.status = result.ground ? VisualStatus::kGood : VisualStatus::kNoPlane;
  noteOutcome(guess.has_value(), result.ground.has_value());
  return result;
}

}  // namespace redbee
