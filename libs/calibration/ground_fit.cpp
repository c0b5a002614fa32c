#include "redbee/calibration/ground_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "redbee/visual/homography_fit.hpp"

namespace redbee::calibration {
namespace {

/// px: scales of the robust loss, from the prediction's error to the tracking noise.
constexpr double kScales_px[] = {2.0, 1.0, 0.5, 0.35, 0.35};
/// px: transfer error of the first fit below which a point is on the ground.
constexpr double kReach_px = 0.6;
constexpr double kSigmaFloor_px = 0.04;
constexpr int kMinPoints = 40;
/// Cells of a tenth of the image's width that must contain ground points.
constexpr size_t kMinCells = 12;
/// Uncertainty of the prediction beside its three deviations, scaled units: keeps P invertible.
constexpr double kFloor = 1e-4;

Matrix8d priorInformation(const CameraIntrinsics& ideal, const GroundPrediction& prediction,
                          const ImageScaling& scaling) {
  const Eigen::Matrix3d K_scaled = scaling.T * Camera(ideal).K();
  const PlaneHomographyJacobians J = planeHomographyJacobians(K_scaled, prediction.motion);
  const double translation_m = prediction.translation_sigma * prediction.motion.h_a;
  Matrix8d P = kFloor * kFloor * Matrix8d::Identity();
  P += std::pow(prediction.rotation_sigma_rad, 2) * J.by_rotation * J.by_rotation.transpose();
  P += std::pow(translation_m, 2) * J.by_translation * J.by_translation.transpose();
  P += std::pow(prediction.normal_sigma_rad, 2) * J.by_normal * J.by_normal.transpose();
  return P.inverse();
}

/// One Gauss-Newton step of the robust fit under the prior.
Eigen::Matrix3d improved(const ScaledPairs& pairs, const Eigen::Matrix3d& H, const Vector8d& h_0,
                         const Matrix8d& prior, double scale, double sigma) {
  Matrix8d A = prior;
  Vector8d b = prior * (h_0 - toVector(H));
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector2d residual = pairs.current(i) - transfer(H, pairs.previous(i));
    const double root = 1.0 / (1.0 + residual.squaredNorm() / (scale * scale));
    const double weight = root * root / (sigma * sigma);
    if (weight * sigma * sigma < 1e-3) continue;
    const Eigen::Matrix<double, 2, 8> J = transferJacobian(H, pairs.previous(i));
    A.noalias() += weight * J.transpose() * J;
    b.noalias() += weight * J.transpose() * residual;
  }
  return fromVector(toVector(H) + A.ldlt().solve(b));
}

std::vector<uint8_t> within(const ScaledPairs& pairs, const Eigen::Matrix3d& H, double reach) {
  std::vector<float> squared;
  squaredErrors(pairs, H, squared);
  std::vector<uint8_t> chosen(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i)
    chosen[i] = squared[i] <= static_cast<float>(reach * reach) ? 1 : 0;
  return chosen;
}

bool spreads(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen) {
  constexpr double kCell = 0.2;  // scaled units: the image is two wide
  std::set<std::pair<int, int>> cells;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (chosen[i] == 0) continue;
    cells.emplace(static_cast<int>(std::floor(pairs.ax[i] / kCell)),
                  static_cast<int>(std::floor(pairs.ay[i] / kCell)));
  }
  return cells.size() >= kMinCells;
}

}  // namespace

std::optional<GroundHomography> fitGround(const PointTracks& points, const CameraIntrinsics& ideal,
                                          const GroundPrediction& prediction) {
  constexpr double kTypicalSigma_px = 0.2;
  const ImageScaling scaling(ideal.width, ideal.height);
  const ScaledPairs pairs(points, scaling);
  const Eigen::Matrix3d predicted = scaling.scale(planeHomography(Camera(ideal).K(), prediction.motion));
  if (!predicted.allFinite()) return std::nullopt;
  const Matrix8d prior = priorInformation(ideal, prediction, scaling);
  Eigen::Matrix3d H = predicted;
  for (const double scale_px : kScales_px) {
    for (int i = 0; i < 3; ++i) {
      H = improved(pairs, H, toVector(predicted), prior, scale_px / scaling.unit_px,
                   kTypicalSigma_px / scaling.unit_px);
    }
  }
  if (!H.allFinite()) return std::nullopt;

  const std::vector<uint8_t> chosen = within(pairs, H, kReach_px / scaling.unit_px);
  const auto count = static_cast<int>(std::count(chosen.begin(), chosen.end(), 1));
  if (count < kMinPoints || !spreads(pairs, chosen)) return std::nullopt;
  const auto fit = fitHomography(pairs, chosen, H, 0.5 * kReach_px / scaling.unit_px, 5);
  if (!fit) return std::nullopt;
  const double floor = kSigmaFloor_px / scaling.unit_px;
  const double variance = std::max(fit->variance, floor * floor);
  GroundHomography ground;
  ground.H = scaling.unscale(fit->H);
  ground.information = fit->inverse_information.inverse() / variance;
  ground.information = 0.5 * (ground.information + ground.information.transpose()).eval();
  ground.points = count;
  ground.rms_px = std::sqrt(2.0 * variance) * scaling.unit_px;
  if (!ground.H.allFinite() || !ground.information.allFinite()) return std::nullopt;
  return ground;
}

}  // namespace redbee::calibration
