#include "visual/homography_estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "visual/homography_fit.hpp"

namespace redbee {
namespace {

/// px, per coordinate: tracking is never believed to be better than this, whatever the residuals say.
constexpr double kSigmaFloorPx = 0.04;
/// px: typical tracking noise, the unit in which points and prediction are weighed against each other.
constexpr double kTypicalSigmaPx = 0.3;
/// Share of inlier_px within which a pair is fitted where a prediction chose the plane: another plane's
/// points, which cross the ground's motion somewhere, are spread evenly over the threshold, the ground's own
/// are not.
constexpr double kNearShare = 0.6;
/// Chi-square quantiles: 2 degrees of freedom at 99 %, 8 at 99.99 %.
constexpr double kPointGate = 9.21;
constexpr double kPlaneGate = 31.83;

/// What the inertial prediction says of a candidate plane.
struct Prior {
  Eigen::Matrix3d H;  ///< scaled
  Matrix8d covariance;
  Eigen::LDLT<Matrix8d> factors;

  FitPrior forFit(double variance) const {
    return {toVector(H), variance * Matrix8d(factors.solve(Matrix8d::Identity()))};
  }

  double squaredDistance(const Eigen::Matrix3d& candidate) const {
    const Vector8d difference = toVector(candidate) - toVector(H);
    return difference.dot(factors.solve(difference));
  }
};

struct Candidate {
  Eigen::Matrix3d H;
  double cost = std::numeric_limits<double>::infinity();
  int inliers = 0;
};

class Ransac {
 public:
  /// `candidates`: indices of the pairs that samples are drawn from and that count.
  Ransac(const ScaledPairs& pairs, std::vector<std::size_t> candidates, double unit_px,
         const RansacParameters& parameters, const Prior* prior)
      : all_(pairs),
        candidates_(std::move(candidates)),
        parameters_(parameters),
        prior_(prior),
        generator_(parameters.seed) {
    chosen_.assign(all_.size(), 0);
    threshold_ = parameters.inlier_px / unit_px;
    typical_variance_ = kCorrelationInflation * std::pow(kTypicalSigmaPx / unit_px, 2);
    if (prior) fit_prior_ = prior->forFit(typical_variance_);
  }

  std::optional<Candidate> run() {
    if (candidates_.size() < 4) return std::nullopt;
    Candidate best;
    if (prior_) improve(prior_->H, best);
    int needed = parameters_.max_iterations;
    for (int i = 0; i < needed; ++i) {
      const auto H = homographyThroughFour(all_, draw());
      if (!H) continue;
      const Candidate candidate = judge(*H);
      // Far better than nothing is not enough: only what may become the best after its refinement is refined.
      if (candidate.inliers < 0.8 * best.inliers) continue;
      if (improve(*H, best)) needed = std::min(needed, neededIterations(best.inliers));
    }
    if (best.inliers < 5) return std::nullopt;
    return best;
  }

 private:
  std::array<std::size_t, 4> draw() {
    // Multiplication instead of std::uniform_int_distribution, whose numbers differ between standard
    // libraries.
    const auto next = [&] {
      return static_cast<std::size_t>((uint64_t{generator_()} * candidates_.size()) >> 32);
    };
    std::array<std::size_t, 4> sample{};
    for (std::size_t i = 0; i < 4; ++i) {
      do {
        sample[i] = candidates_[next()];
      } while (std::find(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(i), sample[i]) !=
               sample.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return sample;
  }

  /// Truncated squared errors (MSAC) in units of the tracking noise, plus the prior's squared distance.
  /// Tracks err together, so that many of them weigh less than their number: without that a facade outvotes
  /// the prior.
  Candidate judge(const Eigen::Matrix3d& H) {
    squaredErrors(all_, H, squared_);
    const auto limit = static_cast<float>(threshold_ * threshold_);
    Candidate candidate{H, 0, 0};
    double sum = 0;
    for (const std::size_t i : candidates_) {
      candidate.inliers += squared_[i] <= limit ? 1 : 0;
      sum += std::min(squared_[i], limit);
    }
    candidate.cost = sum / typical_variance_;
    if (prior_) candidate.cost += prior_->squaredDistance(H);
    return candidate;
  }

  /// Local optimisation (Chum, Matas, Kittler 2003): least squares on the inliers, twice. True where a new
  /// best results.
  bool improve(const Eigen::Matrix3d& start, Candidate& best) {
    constexpr int kRounds = 2;
    Eigen::Matrix3d H = start;
    for (int round = 0; round < kRounds; ++round) {
      choose(H, round == 0 ? 2.0 * threshold_ : threshold_);
      const auto fit =
          fitHomography(all_, chosen_, H, 0.5 * threshold_, 2, fit_prior_ ? &*fit_prior_ : nullptr);
      if (!fit) break;
      H = fit->H;
    }
    bool better = false;
    for (const Eigen::Matrix3d& attempt : {start, H}) {
      const Candidate candidate = judge(attempt);
      if (candidate.cost >= best.cost) continue;
      best = candidate;
      better = true;
    }
    return better;
  }

  void choose(const Eigen::Matrix3d& H, double threshold) {
    squaredErrors(all_, H, squared_);
    const auto limit = static_cast<float>(threshold * threshold);
    for (const std::size_t i : candidates_) chosen_[i] = squared_[i] <= limit ? 1 : 0;
  }

  int neededIterations(int inliers) const {
    const double share = static_cast<double>(inliers) / static_cast<double>(candidates_.size());
    const double clean = std::pow(share, 4);
    if (clean >= 1) return 1;
    if (clean <= 0) return parameters_.max_iterations;
    const double needed = std::log(1 - parameters_.confidence) / std::log1p(-clean);
    return needed < parameters_.max_iterations ? static_cast<int>(std::ceil(needed))
                                               : parameters_.max_iterations;
  }

  const ScaledPairs& all_;
  std::vector<std::size_t> candidates_;
  const RansacParameters& parameters_;
  const Prior* prior_;
  std::optional<FitPrior> fit_prior_;
  std::mt19937 generator_;
  std::vector<float> squared_;
  std::vector<uint8_t> chosen_;
  double threshold_;
  double typical_variance_;
};

void requireValid(const PointTracks& tracks, int width, int height, const RansacParameters& parameters) {
  if (tracks.previous.size() != tracks.current.size())
    throw std::invalid_argument("tracks of unequal length");
  if (width < 2 || height < 2) throw std::invalid_argument("a picture of no size");
  if (!(parameters.inlier_px > 0) || parameters.max_iterations < 1) {
    throw std::invalid_argument("RANSAC's threshold and iterations must be positive");
  }
}

/// Share of the picture's area in cells (a twentieth of the width) that hold at least one inlier.
double spreadOf(const PointTracks& tracks, const std::vector<uint8_t>& inlier, int width, int height) {
  const double cell = width / 20.0;
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (!inlier[i]) continue;
    cells.emplace(static_cast<int>(tracks.previous[i].x / cell),
                  static_cast<int>(tracks.previous[i].y / cell));
  }
  return static_cast<double>(cells.size()) * cell * cell / (static_cast<double>(width) * height);
}

int flagInliers(const ScaledPairs& pairs, const Eigen::Matrix3d& H, double threshold,
                std::vector<uint8_t>& inlier) {
  std::vector<float> squared;
  squaredErrors(pairs, H, squared);
  const auto limit = static_cast<float>(threshold * threshold);
  inlier.assign(pairs.size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    inlier[i] = squared[i] <= limit ? 1 : 0;
    count += inlier[i];
  }
  return count;
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

/// How much larger the covariance is than independent errors would make it: the sum over blocks of the
/// squared sum of a block's residuals, against the sum of squared residuals (the "design effect" of clustered
/// samples). One where residuals are independent; the number of pairs in a block where a block errs as one,
/// as relief does that was taken for the plane.
double correlationOf(const ScaledPairs& pairs, const Eigen::Matrix3d& H, const std::vector<uint8_t>& inlier) {
  constexpr int kBlocks = 6;  // to a side of the picture's width
  constexpr int kParameters = 8;
  std::map<std::pair<int, int>, Eigen::Vector2d> sums;
  double squares = 0;
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (!inlier[i]) continue;
    const Eigen::Vector2d residual = pairs.current(i) - transfer(H, pairs.previous(i));
    // Scaled coordinates run from -1 to 1 over the width.
    const auto block = [](float x) { return static_cast<int>(std::floor((x + 1) * kBlocks / 2)); };
    sums.try_emplace({block(pairs.ax[i]), block(pairs.ay[i])}, Eigen::Vector2d::Zero()).first->second +=
        residual;
    squares += residual.squaredNorm();
  }
  double block_squares = 0;
  for (const auto& [block, sum] : sums) block_squares += sum.squaredNorm();
  // The fit has taken its eight parameters out of the blocks' 2 n means.
  const double freedom = 2.0 * static_cast<double>(sums.size());
  const double taken = freedom > 2 * kParameters ? freedom / (freedom - kParameters) : 2.0;
  return squares > 0 ? taken * block_squares / squares : 1.0;
}

/// kFromStart: the pairs near the starting plane and no others are fitted. A fit that chose its own pairs
/// anew could slide from the predicted ground to a larger plane nearby.
enum class Selection { kFollowsFit, kFromStart };

/// Refines RANSAC's plane on all its inliers, of which `allowed` may be, and states what is known of it.
std::optional<HomographyEstimate> conclude(const PointTracks& tracks, const ScaledPairs& pairs,
                                           const std::vector<uint8_t>& allowed, const Eigen::Matrix3d& start,
                                           const ImageScaling& scaling, int width, int height,
                                           const RansacParameters& parameters, Selection selection) {
  constexpr int kRounds = 3;
  const double threshold = parameters.inlier_px / scaling.unit_px;
  HomographyEstimate estimate;
  std::optional<LeastSquares> fit;
  Eigen::Matrix3d H = start;
  double knee = 0.5 * threshold;
  for (int round = 0; round < kRounds; ++round) {
    if (round == 0 || selection == Selection::kFollowsFit) {
      flagInliers(pairs, H, selection == Selection::kFromStart ? kNearShare * threshold : threshold,
                  estimate.inlier);
      for (std::size_t i = 0; i < allowed.size(); ++i) estimate.inlier[i] &= allowed[i];
    }
    fit = fitHomography(pairs, estimate.inlier, H, knee, 5);
    if (!fit) return std::nullopt;
    H = fit->H;
    knee = std::clamp(1.5 * std::sqrt(fit->variance), 0.1 * threshold, 0.5 * threshold);
  }
  const double floor = kSigmaFloorPx / scaling.unit_px;
  const double inflation = std::max(kCorrelationInflation, correlationOf(pairs, H, estimate.inlier));
  estimate.covariance = inflation * std::max(fit->variance, floor * floor) * fit->inverse_information;
  estimate.H = scaling.unscale(H);
  estimate.inliers = flagInliers(pairs, H, threshold, estimate.inlier);
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (allowed[i] || !estimate.inlier[i]) continue;
    estimate.inlier[i] = 0;
    --estimate.inliers;
  }
  estimate.outliers = static_cast<int>(pairs.size()) - estimate.inliers;
  estimate.rms_px = rmsOf(pairs, H, estimate.inlier) * scaling.unit_px;
  const double share = static_cast<double>(estimate.inliers) /
                       static_cast<double>(std::count(allowed.begin(), allowed.end(), 1));
  if (estimate.inliers < parameters.min_inliers || share < parameters.min_inlier_share) return std::nullopt;
  if (spreadOf(tracks, estimate.inlier, width, height) < parameters.min_spread) return std::nullopt;
  return estimate;
}

std::vector<std::size_t> indicesOf(const std::vector<uint8_t>& flags) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) indices.push_back(i);
  }
  return indices;
}

std::optional<HomographyEstimate> estimateAmong(const PointTracks& tracks,
                                                const std::vector<uint8_t>& allowed, int width, int height,
                                                const RansacParameters& parameters) {
  const ImageScaling scaling(width, height);
  const ScaledPairs pairs(tracks, scaling);
  const auto best = Ransac(pairs, indicesOf(allowed), scaling.unit_px, parameters, nullptr).run();
  if (!best) return std::nullopt;
  return conclude(tracks, pairs, allowed, best->H, scaling, width, height, parameters,
                  Selection::kFollowsFit);
}

/// Pairs that a plane within the prior's uncertainty could explain.
std::vector<std::size_t> candidatesNear(const ScaledPairs& pairs, const Prior& prior, double threshold,
                                        double sigma) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector2d a = pairs.previous(i);
    if ((prior.H * a.homogeneous()).z() <= 1e-6) continue;
    const Eigen::Vector2d residual = pairs.current(i) - transfer(prior.H, a);
    const Eigen::Matrix<double, 2, 8> J = transferJacobian(prior.H, a);
    const Eigen::Matrix2d S =
        J * prior.covariance * J.transpose() + sigma * sigma * Eigen::Matrix2d::Identity();
    const bool close = residual.squaredNorm() <= threshold * threshold;
    if (close || residual.dot(S.ldlt().solve(residual)) <= kPointGate) candidates.push_back(i);
  }
  return candidates;
}

}  // namespace

std::optional<HomographyEstimate> estimateHomography(const PointTracks& tracks, int width, int height,
                                                     const RansacParameters& parameters) {
  requireValid(tracks, width, height, parameters);
  return estimateAmong(tracks, std::vector<uint8_t>(tracks.previous.size(), 1), width, height, parameters);
}

std::optional<HomographyEstimate> estimateHomographyNear(const PointTracks& tracks, int width, int height,
                                                         const Eigen::Matrix3d& prediction,
                                                         const Matrix8d& prediction_covariance,
                                                         const RansacParameters& parameters) {
  requireValid(tracks, width, height, parameters);
  const ImageScaling scaling(width, height);
  const ScaledPairs pairs(tracks, scaling);
  const double sigma = kTypicalSigmaPx / scaling.unit_px;
  // A prediction surer than tracking itself would turn the selection of the points into the answer.
  const Matrix8d floor = Matrix8d::Identity() * std::pow(0.1 * sigma, 2);
  Prior prior{scaling.scale(prediction), prediction_covariance + floor, {}};
  prior.factors.compute(prior.covariance);
  if (!prior.H.allFinite() || prior.factors.info() != Eigen::Success || !prior.factors.isPositive())
    return std::nullopt;

  const auto best = Ransac(pairs, candidatesNear(pairs, prior, parameters.inlier_px / scaling.unit_px, sigma),
                           scaling.unit_px, parameters, &prior)
                        .run();
  if (!best) return std::nullopt;
  const std::vector<uint8_t> everything(pairs.size(), 1);
  auto estimate =
      conclude(tracks, pairs, everything, best->H, scaling, width, height, parameters, Selection::kFromStart);
  if (!estimate) return std::nullopt;
  const Matrix8d S = prior.covariance + estimate->covariance;
  const Vector8d innovation = toVector(scaling.scale(estimate->H)) - toVector(prior.H);
  if (!(innovation.dot(S.ldlt().solve(innovation)) <= kPlaneGate)) return std::nullopt;
  return estimate;
}

FrontPlaneParameters::FrontPlaneParameters() {
  ransac.min_inliers = 40;
  ransac.min_inlier_share = 0.3;
  ransac.min_spread = 0.05;
}

std::optional<HomographyEstimate> estimateFrontPlane(const PointTracks& tracks, const Eigen::Matrix3d& ground,
                                                     int width, int height,
                                                     const FrontPlaneParameters& parameters) {
  requireValid(tracks, width, height, parameters.ransac);
  const ImageScaling scaling(width, height);
  const ScaledPairs pairs(tracks, scaling);
  std::vector<uint8_t> unexplained;
  flagInliers(pairs, scaling.scale(ground), parameters.ground_px / scaling.unit_px, unexplained);
  for (uint8_t& flag : unexplained) flag = flag ? 0 : 1;
  auto front = estimateAmong(tracks, unexplained, width, height, parameters.ransac);
  if (!front) return std::nullopt;

  std::vector<double> separations;
  for (std::size_t i = 0; i < front->inlier.size(); ++i) {
    if (!front->inlier[i]) continue;
    const Eigen::Vector2d p(tracks.previous[i].x, tracks.previous[i].y);
    separations.push_back((transfer(front->H, p) - transfer(ground, p)).norm());
  }
  const auto middle = separations.begin() + static_cast<std::ptrdiff_t>(separations.size() / 2);
  std::nth_element(separations.begin(), middle, separations.end());
  if (*middle < parameters.min_separation_px) return std::nullopt;
  return front;
}

}  // namespace redbee
