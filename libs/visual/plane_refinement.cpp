#include "redbee/visual/plane_refinement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "redbee/visual/homography_fit.hpp"

namespace redbee {
namespace {

/// px, per coordinate: lower bound of the tracking noise, whatever the residuals.
constexpr double kSigmaFloorPx = 0.04;
/// Fraction of inlier_px within which a pair is fitted where a prediction chose the plane: another plane's
/// points, which cross the ground's motion somewhere, are spread evenly over the threshold, the ground's own
/// are not.
constexpr double kNearFraction = 0.6;
/// Threshold of the Huber kernel in standard deviations of the residuals, bounded by these fractions of the
/// inlier threshold.
constexpr double kKneeSigmas = 1.5;
constexpr double kSmallestKnee = 0.1;
constexpr double kLargestKnee = 0.5;

/// Number of square cells along the image's width. Scaled coordinates range from -1 to 1 over the width.
class Cells {
 public:
  Cells(cv::Size image, int columns)
      : columns_(columns),
        rows_(std::max(1, (columns * image.height + image.width - 1) / image.width)),
        aspect_(static_cast<float>(image.height) / static_cast<float>(image.width)) {}

  std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  /// Cell of a point; one outside the image counts for the cell at the border.
  std::size_t at(float x, float y) const {
    const int column = index((x + 1) / 2, columns_);
    return static_cast<std::size_t>(index((y + aspect_) / 2, rows_) * columns_ + column);
  }

 private:
  int index(float fraction_of_width, int count) const {
    const float cell = std::floor(fraction_of_width * static_cast<float>(columns_));
    return static_cast<int>(std::clamp(cell, 0.0F, static_cast<float>(count - 1)));
  }

  int columns_;
  int rows_;
  float aspect_;
};

/// Fraction of the image's area in cells that contain at least one inlier.
double spreadOf(const ScaledPairs& pairs, const std::vector<uint8_t>& inlier, cv::Size image) {
  constexpr int kColumns = 20;
  const Cells cells(image, kColumns);
  std::vector<uint8_t> held(cells.size(), 0);
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (inlier[i]) held[cells.at(pairs.ax[i], pairs.ay[i])] = 1;
  }
  const double cell_fraction =
      static_cast<double>(image.width) / (static_cast<double>(kColumns) * kColumns * image.height);
  return static_cast<double>(std::count(held.begin(), held.end(), 1)) * cell_fraction;
}

double rmsOf(const ScaledPairs& pairs, const Eigen::Matrix3d& H, const std::vector<uint8_t>& inlier) {
  std::vector<float> squared;
  squaredErrors(pairs, H, squared);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!inlier[i]) continue;
    sum += squared[i];
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

/// Inflation of the covariance by correlated errors: the sum over blocks of the squared sum of a block's
/// residuals, over the sum of squared residuals (the "design effect" of clustered samples). 1 for independent
/// residuals; the number of pairs in a block if a block's errors are equal, as with relief taken for the
/// plane.
double correlationOf(const ScaledPairs& pairs, const Eigen::Matrix3d& H, const std::vector<uint8_t>& inlier,
                     cv::Size image) {
  constexpr int kColumns = 6;
  constexpr int kParameters = 8;
  const Cells blocks(image, kColumns);
  std::vector<Eigen::Vector3d> sums(blocks.size(), Eigen::Vector3d::Zero());  // of residuals; how many
  double squares = 0;
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (!inlier[i]) continue;
    const Eigen::Vector2d residual = pairs.current(i) - transfer(H, pairs.previous(i));
    sums[blocks.at(pairs.ax[i], pairs.ay[i])] += residual.homogeneous();
    squares += residual.squaredNorm();
  }
  double block_squares = 0;
  double freedom = 0;
  for (const Eigen::Vector3d& sum : sums) {
    block_squares += sum.head<2>().squaredNorm();
    freedom += sum.z() > 0 ? 2 : 0;
  }
  // The fit has used eight of the degrees of freedom of the blocks' 2 n means.
  const double taken = freedom > 2 * kParameters ? freedom / (freedom - kParameters) : 2.0;
  return squares > 0 ? taken * block_squares / squares : 1.0;
}

void keepAllowed(const std::vector<uint8_t>& allowed, std::vector<uint8_t>& inlier) {
  for (std::size_t i = 0; i < allowed.size(); ++i) inlier[i] &= allowed[i];
}

int countOf(const std::vector<uint8_t>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), 1));
}

}  // namespace

std::optional<HomographyEstimate> refinePlane(const ScaledPairs& pairs, const std::vector<uint8_t>& allowed,
                                              const Eigen::Matrix3d& start, cv::Size image,
                                              const RansacParameters& parameters, Selection selection) {
  constexpr int kRounds = 3;
  const ImageScaling scaling(image.width, image.height);
  const double threshold = parameters.inlier_px / scaling.unit_px;
  HomographyEstimate estimate;
  std::optional<LeastSquares> fit;
  Eigen::Matrix3d H = start;
  double knee = kLargestKnee * threshold;
  for (int round = 0; round < kRounds; ++round) {
    if (round == 0 || selection == Selection::kFollowsFit) {
      flagInliers(pairs, H, selection == Selection::kFromStart ? kNearFraction * threshold : threshold,
                  estimate.inlier);
      keepAllowed(allowed, estimate.inlier);
    }
    fit = fitHomography(pairs, estimate.inlier, H, knee, 5);
    if (!fit) return std::nullopt;
    H = fit->H;
    knee = std::clamp(kKneeSigmas * std::sqrt(fit->variance), kSmallestKnee * threshold,
                      kLargestKnee * threshold);
  }
  const double floor = kSigmaFloorPx / scaling.unit_px;
  const double inflation = std::max(kCorrelationInflation, correlationOf(pairs, H, estimate.inlier, image));
  estimate.covariance = inflation * std::max(fit->variance, floor * floor) * fit->inverse_information;
  estimate.H = scaling.unscale(H);
  flagInliers(pairs, H, threshold, estimate.inlier);
  keepAllowed(allowed, estimate.inlier);
  estimate.inliers = countOf(estimate.inlier);
  estimate.outliers = static_cast<int>(pairs.size()) - estimate.inliers;
  estimate.rms_px = rmsOf(pairs, H, estimate.inlier) * scaling.unit_px;
  const double fraction = static_cast<double>(estimate.inliers) / countOf(allowed);
  if (estimate.inliers < parameters.min_inliers || fraction < parameters.min_inlier_ratio)
    return std::nullopt;
  if (spreadOf(pairs, estimate.inlier, image) < parameters.min_spread) return std::nullopt;
  return estimate;
}

}  // namespace redbee
