#include "visual/visual_homography.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace redbee {
namespace {

/// Share of all tracks that a plane must explain to be believed against the prediction, and how many times
/// more than the predicted plane.
constexpr double kContradiction = 0.6;
constexpr double kOverwhelming = 2.0;

/// Mean squared gradient [grey levels^2] of the half-size picture in the direction that has least of it:
/// noise counts little at half size, and a picture blurred along one direction only is blurred.
double sharpnessOf(const cv::Mat& grey) {
  if (grey.cols < 8 || grey.rows < 8) return 0;
  cv::Mat half, dx, dy;
  cv::pyrDown(grey, half);
  cv::Sobel(half, dx, CV_16S, 1, 0, 1, 0.5);
  cv::Sobel(half, dy, CV_16S, 0, 1, 1, 0.5);
  const double pixels = static_cast<double>(half.total());
  Eigen::Matrix2d tensor;
  tensor << dx.dot(dx), dx.dot(dy), dy.dot(dx), dy.dot(dy);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tensor / pixels).eigenvalues()(0);
}

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
  }
  return "unknown";
}

VisualHomographyEstimator::VisualHomographyEstimator(const VisualParameters& parameters)
    : parameters_(parameters), tracker_(parameters.tracker) {}

void VisualHomographyEstimator::forgetReference() {
  tracker_.reset();
  previous_utime_.reset();
  reference_sharpness_ = 0;
}

void VisualHomographyEstimator::adopt(int64_t utime, const cv::Mat& grey, double sharpness) {
  previous_utime_ = utime;
  size_ = grey.size();
  reference_sharpness_ = sharpness;
}

bool VisualHomographyEstimator::isBlind(const cv::Mat& grey, double sharpness) {
  if (sharpness < parameters_.min_sharpness) return true;
  if (sharpness < parameters_.min_sharpness_share * reference_sharpness_) return true;
  return tracker_.texturedPoints(grey) < parameters_.ransac.min_inliers;
}

std::optional<HomographyEstimate> VisualHomographyEstimator::estimateGround(
    const PointTracks& tracks, const std::optional<HomographyPrediction>& prediction) const {
  RansacParameters ransac = parameters_.ransac;
  if (!prediction) return estimateHomography(tracks, size_.width, size_.height, ransac);
  auto near = estimateHomographyNear(tracks, size_.width, size_.height, prediction->H, prediction->covariance,
                                     ransac);
  const auto all = static_cast<double>(tracks.previous.size());
  if (near && near->inliers >= kContradiction * all) return near;
  // A plane that contradicts the prediction is believed only when it explains most of the picture: then it is
  // the prediction that has gone wrong, and the few points near it are chance.
  ransac.min_inlier_share = std::max(ransac.min_inlier_share, kContradiction);
  auto largest = estimateHomography(tracks, size_.width, size_.height, ransac);
  if (near && (!largest || largest->inliers < kOverwhelming * near->inliers)) return near;
  return largest;
}

VisualHomography VisualHomographyEstimator::step(int64_t utime, const cv::Mat& grey,
                                                 const std::optional<HomographyPrediction>& prediction) {
  if (grey.empty() || grey.type() != CV_8UC1) {
    throw std::invalid_argument("the visual stage takes 8-bit pictures of one channel");
  }
  VisualHomography result;
  result.utime = utime;
  const bool connected = previous_utime_ && utime > *previous_utime_ &&
                         static_cast<double>(utime - *previous_utime_) <= 1e6 * parameters_.max_frame_gap_s &&
                         grey.size() == size_;
  if (!connected) forgetReference();
  result.utime_previous = previous_utime_.value_or(utime);

  const double sharpness = sharpnessOf(grey);
  if (isBlind(grey, sharpness)) {
    result.status = VisualStatus::kNoTexture;
    return result;
  }
  const std::optional<Eigen::Matrix3d> guess =
      prediction && prediction->H.allFinite() ? std::optional(prediction->H) : std::nullopt;
  result.tracks = tracker_.advance(grey, guess);
  adopt(utime, grey, sharpness);
  if (!connected) return result;

  if (static_cast<int>(result.tracks.previous.size()) < parameters_.ransac.min_inliers) {
    result.status = VisualStatus::kNoTexture;
    return result;
  }
  result.ground = estimateGround(result.tracks, guess ? prediction : std::nullopt);
  result.status = result.ground ? VisualStatus::kGood : VisualStatus::kNoPlane;
  return result;
}

}  // namespace redbee
