#include "redbee/visual/homography_fit.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/visual/normal_equations.hpp"

namespace redbee {
namespace {

/// A step shorter than this moves no point of the image by a thousandth of a pixel (scaled units, 640 px).
constexpr double kConverged = 1e-6;

/// Factor of (J' W J)^-1 for the estimate's covariance (Huber, Robust Statistics, 7.6): E[psi^2] / E[psi']^2
/// belongs to (J'J)^-1, and W brings in its mean.
double varianceOf(const NormalEquations& equations, int pairs) {
  const double influence = equations.influence_squares / std::max(2 * pairs - 8, 1);
  const double slope = equations.slopes / pairs;
  return influence * (equations.weights / pairs) / (slope * slope);
}

NormalEquations linearise(const PackedPairs& pairs, const Eigen::Matrix3d& H, double knee,
                          const FitPrior* prior) {
  NormalEquations equations = pairs.linearise(H, knee);
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
  // Twice the area of a triangle, in squared half-widths: about 10 x 10 px of a VGA image.
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
  const PackedPairs packed(pairs, chosen);
  if (packed.size() < 5) return std::nullopt;
  Vector8d h = toVector(start);
  NormalEquations equations = linearise(packed, start, knee, prior);
  if (!std::isfinite(equations.cost)) return std::nullopt;
  double damping = 1e-6;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Matrix8d damped = equations.information;
    damped.diagonal() *= 1 + damping;
    const Vector8d step = LdltFactors(damped).solve(equations.gradient);
    if (!step.allFinite()) return std::nullopt;
    const NormalEquations next = linearise(packed, fromVector(h + step), knee, prior);
    if (next.cost <= equations.cost) {
      h += step;
      equations = next;
      damping *= 0.1;
    } else {
      damping = std::max(1e-4, damping * 10);
    }
    if (step.norm() < kConverged) break;
  }
  const LdltFactors factors(equations.information);
  if (!factors.succeeded() || !factors.isPositive() || factors.reciprocalCondition() < 1e-12)
    return std::nullopt;
  LeastSquares fit;
  fit.H = fromVector(h);
  fit.inverse_information = factors.inverse();
  fit.inverse_information = 0.5 * (fit.inverse_information + fit.inverse_information.transpose()).eval();
  fit.variance = varianceOf(equations, packed.size());
  return fit;
}

}  // namespace redbee
