#include "redbee/visual/homography_estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/visual/plane_refinement.hpp"
#include "redbee/visual/scaled_pairs.hpp"

namespace redbee {
namespace {

constexpr double kPointProbability = 0.99;    // chi-square gate of one pair, 2 degrees of freedom
constexpr double kPlaneProbability = 0.9999;  // of the plane against its prediction, 8 degrees of freedom
/// Standard deviation of a prediction's entries, in units of the tracking noise, below which none is
/// accepted: a prediction more certain than tracking itself would decide the result by the selection of
/// points.
constexpr double kPriorFloor = 0.1;

void requireValid(int width, int height, const RansacParameters& parameters) {
  if (width < 2 || height < 2) throw std::invalid_argument("an image of no size");
  if (!(parameters.inlier_px > 0) || parameters.max_iterations < 1) {
    throw std::invalid_argument("RANSAC's threshold and iterations must be positive");
  }
}

ScaledPairs chosenOf(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen) {
  ScaledPairs some;
  some.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (chosen[i]) some.append(pairs.ax[i], pairs.ay[i], pairs.bx[i], pairs.by[i]);
  }
  return some;
}

/// Pairs that a plane within the prior's uncertainty could explain.
std::vector<uint8_t> flagNear(const ScaledPairs& pairs, const PlanePrior& prior, double threshold,
                              double sigma) {
  static const double gate = chiSquareQuantile(kPointProbability, 2);
  std::vector<uint8_t> near(pairs.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector2d a = pairs.previous(i);
    if ((prior.H * a.homogeneous()).z() <= 1e-6) continue;
    const Eigen::Vector2d residual = pairs.current(i) - transfer(prior.H, a);
    if (residual.squaredNorm() <= threshold * threshold) {
      near[i] = 1;
      continue;
    }
    const Eigen::Matrix<double, 2, 8> J = transferJacobian(prior.H, a);
    const Eigen::Matrix2d S =
        transferCovariance(J, prior.covariance) + sigma * sigma * Eigen::Matrix2d::Identity();
    near[i] = residual.dot(S.ldlt().solve(residual)) <= gate ? 1 : 0;
  }
  return near;
}

}  // namespace

std::optional<HomographyEstimate> estimateHomography(const PointTracks& tracks, int width, int height,
                                                     const RansacParameters& parameters) {
  return estimateHomographyAmong(tracks, std::vector<uint8_t>(tracks.previous.size(), 1), width, height,
                                 parameters);
}

std::optional<HomographyEstimate> estimateHomographyAmong(const PointTracks& tracks,
                                                          const std::vector<uint8_t>& chosen, int width,
                                                          int height, const RansacParameters& parameters) {
  requireValid(width, height, parameters);
  const ImageScaling scaling(width, height);
  const ScaledPairs pairs(tracks, scaling);
  const auto best = Ransac(chosenOf(pairs, chosen), scaling.unit_px, parameters, nullptr).run();
  if (!best) return std::nullopt;
  return refinePlane(pairs, chosen, *best, {width, height}, parameters, Selection::kFollowsFit);
}

std::optional<HomographyEstimate> estimateHomographyNear(const PointTracks& tracks, int width, int height,
                                                         const Eigen::Matrix3d& prediction,
                                                         const Matrix8d& prediction_covariance,
                                                         const RansacParameters& parameters) {
  requireValid(width, height, parameters);
  const ImageScaling scaling(width, height);
  const ScaledPairs pairs(tracks, scaling);
  const double sigma = kTypicalSigmaPx / scaling.unit_px;
  const Matrix8d floor = Matrix8d::Identity() * std::pow(kPriorFloor * sigma, 2);
  const PlanePrior prior(scaling.scale(prediction), prediction_covariance + floor);
  if (!prior.isUsable()) return std::nullopt;

  const std::vector<uint8_t> near = flagNear(pairs, prior, parameters.inlier_px / scaling.unit_px, sigma);
  const auto best = Ransac(chosenOf(pairs, near), scaling.unit_px, parameters, &prior).run();
  if (!best) return std::nullopt;
  const std::vector<uint8_t> everything(pairs.size(), 1);
  auto estimate = refinePlane(pairs, everything, *best, {width, height}, parameters, Selection::kFromStart);
  if (!estimate) return std::nullopt;
  const Matrix8d S = prior.covariance + estimate->covariance;
  const Vector8d innovation = toVector(scaling.scale(estimate->H)) - toVector(prior.H);
  static const double gate = chiSquareQuantile(kPlaneProbability, 8);
  if (!(innovation.dot(LdltFactors(S).solve(innovation)) <= gate)) return std::nullopt;
  return estimate;
}

}  // namespace redbee
