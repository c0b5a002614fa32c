#include "visual/homography_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr float kFar = 1e6F;

struct NormalEquations {
  Matrix8d information = Matrix8d::Zero();
  Vector8d gradient = Vector8d::Zero();
  double cost = 0;               ///< Huber
  double influence_squares = 0;  ///< sum of (w r)^2
  double weights = 0;            ///< sum of w
  double slopes = 0;             ///< sum of the influence function's slope, mean of the two directions
  int pairs = 0;
};

/// What to multiply (J' W J)^-1 with for the estimate's covariance (Huber, Robust Statistics, 7.6): E[psi^2]
/// / E[psi']^2 belongs to (J'J)^-1, and W brings in its mean.
double varianceOf(const NormalEquations& equations) {
  const double influence = equations.influence_squares / std::max(2 * equations.pairs - 8, 1);
  const double slope = equations.slopes / equations.pairs;
  return influence * (equations.weights / equations.pairs) / (slope * slope);
}

double huberCost(double squared, double knee) {
  return squared <= knee * knee ? 0.5 * squared : knee * (std::sqrt(squared) - 0.5 * knee);
}

NormalEquations linearise(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen,
                          const Eigen::Matrix3d& H, double knee, const FitPrior* prior) {
  NormalEquations equations;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!chosen[i]) continue;
    const Eigen::Vector2d a = pairs.previous(i);
    const Eigen::Vector2d residual = pairs.current(i) - transfer(H, a);
    const Eigen::Matrix<double, 2, 8> J = transferJacobian(H, a);
    const double squared = residual.squaredNorm();
    const double weight = squared <= knee * knee ? 1.0 : knee / std::sqrt(squared);
    equations.information.noalias() += weight * J.transpose() * J;
    equations.gradient.noalias() += weight * J.transpose() * residual;
    equations.cost += huberCost(squared, knee);
    equations.influence_squares += weight * weight * squared;
    equations.weights += weight;
    // Beyond the knee the influence keeps its length: it only turns with the residual's direction.
    equations.slopes += weight < 1 ? 0.5 * weight : 1.0;
    ++equations.pairs;
  }
  if (prior) {
    const Vector8d difference = prior->mean - toVector(H);
    equations.information += prior->information;
    equations.gradient += prior->information * difference;
    equations.cost += 0.5 * difference.dot(prior->information * difference);
  }
  return equations;
}

double areaOf(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& r) {
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

/// The projective basis whose unit points are the four points.
Eigen::Matrix3d basisOf(const std::array<Eigen::Vector2d, 4>& p) {
  Eigen::Matrix3d M;
  M << p[0].homogeneous(), p[1].homogeneous(), p[2].homogeneous();
  return M * (M.inverse() * p[3].homogeneous()).asDiagonal();
}

bool isWellPosed(const std::array<Eigen::Vector2d, 4>& a, const std::array<Eigen::Vector2d, 4>& b) {
  // Twice the area of a triangle, in squared half-widths: about 10 x 10 px of a VGA picture.
  constexpr double kMinArea = 1e-3;
  constexpr int kTriangles[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  for (const auto& t : kTriangles) {
    const double before = areaOf(a[t[0]], a[t[1]], a[t[2]]);
    const double after = areaOf(b[t[0]], b[t[1]], b[t[2]]);
    if (std::abs(before) < kMinArea || std::abs(after) < kMinArea || before * after < 0) return false;
  }
  return true;
}

}  // namespace

ScaledPairs::ScaledPairs(const PointTracks& tracks, const ImageScaling& scaling) {
  const auto scaleX = [&](float x) { return static_cast<float>(scaling.T(0, 0) * x + scaling.T(0, 2)); };
  const auto scaleY = [&](float y) { return static_cast<float>(scaling.T(1, 1) * y + scaling.T(1, 2)); };
  for (std::size_t i = 0; i < tracks.previous.size(); ++i) {
    ax.push_back(scaleX(tracks.previous[i].x));
    ay.push_back(scaleY(tracks.previous[i].y));
    bx.push_back(scaleX(tracks.current[i].x));
    by.push_back(scaleY(tracks.current[i].y));
  }
}

void squaredErrors(const ScaledPairs& pairs, const Eigen::Matrix3d& H, std::vector<float>& squared) {
  const Eigen::Matrix3f h = H.cast<float>();
  squared.resize(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const float x = pairs.ax[i], y = pairs.ay[i];
    const float w = h(2, 0) * x + h(2, 1) * y + h(2, 2);
    const float depth = w > 1e-6F ? w : 1e-6F;
    const float ex = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) / depth - pairs.bx[i];
    const float ey = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) / depth - pairs.by[i];
    squared[i] = w > 1e-6F ? ex * ex + ey * ey : kFar;
  }
}

std::optional<Eigen::Matrix3d> homographyThroughFour(const ScaledPairs& pairs,
                                                     const std::array<std::size_t, 4>& sample) {
  std::array<Eigen::Vector2d, 4> a, b;
  for (std::size_t i = 0; i < 4; ++i) {
    a[i] = pairs.previous(sample[i]);
    b[i] = pairs.current(sample[i]);
  }
  if (!isWellPosed(a, b)) return std::nullopt;
  const Eigen::Matrix3d H = basisOf(b) * basisOf(a).inverse();
  if (!H.allFinite() || std::abs(H(2, 2)) < 1e-6 * H.norm()) return std::nullopt;
  return normaliseHomography(H);
}

std::optional<LeastSquares> fitHomography(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen,
                                          const Eigen::Matrix3d& start, double knee, int iterations,
                                          const FitPrior* prior) {
  Vector8d h = toVector(start);
  NormalEquations equations = linearise(pairs, chosen, start, knee, prior);
  if (equations.pairs < 5 || !std::isfinite(equations.cost)) return std::nullopt;
  double damping = 1e-6;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Matrix8d damped = equations.information;
    damped.diagonal() *= 1 + damping;
    const Vector8d step = damped.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return std::nullopt;
    const NormalEquations next = linearise(pairs, chosen, fromVector(h + step), knee, prior);
    if (next.cost <= equations.cost) {
      h += step;
      equations = next;
      damping *= 0.1;
      if (step.norm() < 1e-9) break;
    } else {
      damping = std::max(1e-4, damping * 10);
    }
  }
  const Eigen::LDLT<Matrix8d> factors(equations.information);
  if (factors.info() != Eigen::Success || !factors.isPositive() || factors.rcond() < 1e-12)
    return std::nullopt;
  LeastSquares fit;
  fit.H = fromVector(h);
  fit.inverse_information = factors.solve(Matrix8d::Identity());
  fit.inverse_information = 0.5 * (fit.inverse_information + fit.inverse_information.transpose()).eval();
  fit.variance = varianceOf(equations);
  return fit;
}

}  // namespace redbee
