// RANSAC for the dominant plane, with local optimisation (Chum, Matas, Kittler 2003). Scaled coordinates
// (geometry/homography.hpp, ImageScaling).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/visual/homography_fit.hpp"

namespace redbee {

struct RansacParameters {
  double inlier_px = 1.0;  ///< px: transfer error below which a point follows the plane
  int max_iterations = 400;
  double confidence = 0.999;      ///< probability of having drawn one sample without outliers
  int min_inliers = 40;           ///< with fewer, no plane is found
  double min_inlier_ratio = 0.0;  ///< of all correspondences
  double min_spread = 0.02;       ///< of the image's area: what the inliers' grid cells must cover
  uint32_t seed = 1;              ///< of the sampler: the same input gives the same output
};

/// Neighbouring patches overlap and have common noise and bias (interpolation, compression, relief), so their
/// errors are correlated; the part that the fit absorbs does not show in its residuals. The covariance of
/// independent errors is inflated by this factor: consistent (median normalised error at most that of
/// chi-square with 8 degrees of freedom) for rendered flights over flat ground. If relief makes the residuals
/// of whole blocks equal, a larger factor is measured (plane_refinement.cpp). The bias of a facade taken for
/// ground does not show in the residuals.
inline constexpr double kCorrelationInflation = 6.0;

/// px: typical tracking noise, the unit in which points are weighted against the prediction.
inline constexpr double kTypicalSigmaPx = 0.3;

/// The inertial prediction as a prior on candidate planes.
struct PlanePrior {
  /// `H`, `covariance`: scaled.
  PlanePrior(const Eigen::Matrix3d& H, const Matrix8d& covariance);

  bool isUsable() const;
  FitPrior forFit(double variance) const;
  double squaredDistance(const Eigen::Matrix3d& candidate) const;

  Eigen::Matrix3d H;
  Matrix8d covariance;
  LdltFactors factors;
};

class Ransac {
 public:
  /// `candidates`: the pairs to sample from and to score with. `unit_px`: pixels per scaled unit.
  Ransac(ScaledPairs candidates, double unit_px, const RansacParameters& parameters, const PlanePrior* prior);

  /// std::nullopt if no plane has five inliers.
  std::optional<Eigen::Matrix3d> run();

 private:
  struct Candidate {
    Eigen::Matrix3d H;
    double cost = std::numeric_limits<double>::infinity();
    int inliers = 0;
  };

  std::array<std::size_t, 4> draw();
  Candidate score(const Eigen::Matrix3d& H);
  bool improve(const Eigen::Matrix3d& start, Candidate& best);
  int neededIterations(int inliers) const;

  ScaledPairs candidates_;
  const RansacParameters& parameters_;
  const PlanePrior* prior_;
  std::optional<FitPrior> fit_prior_;
  std::mt19937 generator_;
  std::vector<float> squared_;
  std::vector<uint8_t> chosen_;
  double threshold_;
  double typical_variance_;
};

}  // namespace redbee
