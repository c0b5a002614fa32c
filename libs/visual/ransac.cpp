#include "redbee/visual/ransac.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace redbee {
namespace {

/// A candidate with fewer inliers than this fraction of the best one's is not refined: it would not become
/// the best.
constexpr double kWorthRefining = 0.8;
/// Inlier threshold of the first refinement, in units of the final one, as a plane through four noisy pairs
/// is inaccurate.
constexpr double kFirstThreshold = 2.0;
/// Threshold of the Huber kernel, as a fraction of the inlier threshold.
constexpr double kKnee = 0.5;

}  // namespace

PlanePrior::PlanePrior(const Eigen::Matrix3d& H_scaled, const Matrix8d& covariance_scaled)
    : H(H_scaled), covariance(covariance_scaled), factors(covariance) {}

bool PlanePrior::isUsable() const { return H.allFinite() && factors.succeeded() && factors.isPositive(); }

FitPrior PlanePrior::forFit(double variance) const { return {toVector(H), variance * factors.inverse()}; }

double PlanePrior::squaredDistance(const Eigen::Matrix3d& candidate) const {
  const Vector8d difference = toVector(candidate) - toVector(H);
  return difference.dot(factors.solve(difference));
}

Ransac::Ransac(ScaledPairs candidates, double unit_px, const RansacParameters& parameters,
               const PlanePrior* prior)
    : candidates_(std::move(candidates)),
      parameters_(parameters),
      prior_(prior),
      generator_(parameters.seed),
      threshold_(parameters.inlier_px / unit_px),
      typical_variance_(kCorrelationInflation * std::pow(kTypicalSigmaPx / unit_px, 2)) {
  if (prior) fit_prior_ = prior->forFit(typical_variance_);
}

std::optional<Eigen::Matrix3d> Ransac::run() {
  if (candidates_.size() < 4) return std::nullopt;
  Candidate best;
  int needed = parameters_.max_iterations;
  if (prior_ && improve(prior_->H, best)) needed = neededIterations(best.inliers);
  for (int i = 0; i < needed; ++i) {
    const auto H = homographyThroughFour(candidates_, draw());
    if (!H) continue;
    const Candidate candidate = score(*H);
    if (candidate.inliers < kWorthRefining * best.inliers) continue;
    if (improve(*H, best)) needed = std::min(needed, neededIterations(best.inliers));
  }
  if (best.inliers < 5) return std::nullopt;
  return best.H;
}

std::array<std::size_t, 4> Ransac::draw() {
  // Multiplication instead of std::uniform_int_distribution, whose numbers differ between standard libraries.
  const auto next = [&] {
    return static_cast<std::size_t>((uint64_t{generator_()} * candidates_.size()) >> 32);
  };
  std::array<std::size_t, 4> sample{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto drawn = sample.begin() + static_cast<std::ptrdiff_t>(i);
    do {
      sample[i] = next();
    } while (std::find(sample.begin(), drawn, sample[i]) != drawn);
  }
  return sample;
}

/// Truncated squared errors (MSAC) in units of the tracking noise, plus the prior's squared distance. Errors
/// of tracks are correlated, so their sum is scaled down; otherwise a facade outweighs the prior.
Ransac::Candidate Ransac::score(const Eigen::Matrix3d& H) {
  squaredErrors(candidates_, H, squared_);
  const auto limit = static_cast<float>(threshold_ * threshold_);
  Candidate candidate{H, 0, 0};
  double sum = 0;
  for (const float squared : squared_) {
    candidate.inliers += squared <= limit ? 1 : 0;
    sum += std::min(squared, limit);
  }
  candidate.cost = sum / typical_variance_;
  if (prior_) candidate.cost += prior_->squaredDistance(H);
  return candidate;
}

/// Least squares on the inliers, twice. True if a new best results.
bool Ransac::improve(const Eigen::Matrix3d& start, Candidate& best) {
  constexpr int kRounds = 2;
  Eigen::Matrix3d H = start;
  for (int round = 0; round < kRounds; ++round) {
    flagInliers(candidates_, H, round == 0 ? kFirstThreshold * threshold_ : threshold_, chosen_);
    const auto fit =
        fitHomography(candidates_, chosen_, H, kKnee * threshold_, 2, fit_prior_ ? &*fit_prior_ : nullptr);
    if (!fit) break;
    H = fit->H;
  }
  bool better = false;
  for (const Eigen::Matrix3d& attempt : {start, H}) {
    const Candidate candidate = score(attempt);
    if (candidate.cost >= best.cost) continue;
    best = candidate;
    better = true;
  }
  return better;
}

int Ransac::neededIterations(int inliers) const {
  const double fraction = static_cast<double>(inliers) / static_cast<double>(candidates_.size());
  const double clean = std::pow(fraction, 4);
  if (clean >= 1) return 1;
  if (clean <= 0) return parameters_.max_iterations;
  const double needed = std::log(1 - parameters_.confidence) / std::log1p(-clean);
  return needed < parameters_.max_iterations ? static_cast<int>(std::ceil(needed))
                                             : parameters_.max_iterations;
}

}  // namespace redbee
