#include "redbee/visual/normal_equations.hpp"

#include <array>
#include <cmath>

namespace redbee {
namespace {

constexpr std::size_t kLanes = 4;
using Lanes = Eigen::Array<float, kLanes, 1>;

Lanes load(const std::vector<float>& values, std::size_t at) {
  return Eigen::Map<const Lanes>(values.data() + at);
}

/// With (u, v) where a point (x, y) goes and d the depth that it is divided by, the two rows of its Jacobian
/// are (x, y, 1, 0, 0, 0, -u x, -u y) / d and (0, 0, 0, x, y, 1, -v x, -v y) / d: of their products only
/// these sums differ. In each: x^2, x y, x, y^2, y, 1, times the weight and 1 / d^2.
struct LaneSums {
  using Products = std::array<Lanes, 6>;
  Products plain, by_u, by_v, by_uv;  ///< by_uv: times u^2 + v^2
  std::array<Lanes, 8> gradient;
  Lanes cost, influence_squares, weights, slopes;

  LaneSums() {
    for (Products* products : {&plain, &by_u, &by_v, &by_uv}) products->fill(Lanes::Zero());
    gradient.fill(Lanes::Zero());
    cost = influence_squares = weights = slopes = Lanes::Zero();
  }
};

void addProducts(const LaneSums::Products& products, const Lanes& factor, LaneSums::Products& sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += factor * products[i];
}

double total(const Lanes& lanes) { return lanes.cast<double>().sum(); }

/// The six products as the symmetric matrix of (x, y, 1)' (x, y, 1).
Eigen::Matrix3d matrixOf(const LaneSums::Products& sums) {
  std::array<double, 6> s{};
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = total(sums[i]);
  Eigen::Matrix3d M;
  M << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  return M;
}

NormalEquations assemble(const LaneSums& sums) {
  const Eigen::Matrix3d plain = matrixOf(sums.plain);
  NormalEquations equations;
  Matrix8d& information = equations.information;
  information.block<3, 3>(0, 0) = plain;
  information.block<3, 3>(3, 3) = plain;
  information.block<3, 2>(0, 6) = -matrixOf(sums.by_u).leftCols<2>();
  information.block<3, 2>(3, 6) = -matrixOf(sums.by_v).leftCols<2>();
  information.block<2, 6>(6, 0) = information.block<6, 2>(0, 6).transpose();
  information.block<2, 2>(6, 6) = matrixOf(sums.by_uv).topLeftCorner<2, 2>();
  for (std::size_t i = 0; i < sums.gradient.size(); ++i) {
    equations.gradient(static_cast<Eigen::Index>(i)) = total(sums.gradient[i]);
  }
  equations.cost = total(sums.cost);
  equations.influence_squares = total(sums.influence_squares);
  equations.weights = total(sums.weights);
  equations.slopes = total(sums.slopes);
  return equations;
}

}  // namespace

PackedPairs::PackedPairs(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen) {
  const std::size_t room = (chosen.size() + kLanes - 1) / kLanes * kLanes;
  for (auto* values : {&pairs_.ax, &pairs_.ay, &pairs_.bx, &pairs_.by}) values->reserve(room);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (chosen[i]) pairs_.append(pairs.ax[i], pairs.ay[i], pairs.bx[i], pairs.by[i]);
  }
  size_ = static_cast<int>(pairs_.size());
  counts_.assign(pairs_.size(), 1);
  while (pairs_.size() % kLanes != 0) pairs_.append(0, 0, 0, 0);
  counts_.resize(pairs_.size(), 0);
}

NormalEquations PackedPairs::linearise(const Eigen::Matrix3d& H, double knee) const {
  const Eigen::Matrix3f h = H.cast<float>();
  const auto knee_f = static_cast<float>(knee);
  constexpr float kTiny = 1e-30F;  // of a squared residual: keeps its root from being divided by zero
  LaneSums sums;
  for (std::size_t i = 0; i < pairs_.size(); i += kLanes) {
    const Lanes x = load(pairs_.ax, i), y = load(pairs_.ay, i), counts = load(counts_, i);
    const Lanes inverse_depth = (h(2, 0) * x + h(2, 1) * y + h(2, 2)).inverse();
    const Lanes u = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) * inverse_depth;
    const Lanes v = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) * inverse_depth;
    const Lanes off_u = load(pairs_.bx, i) - u, off_v = load(pairs_.by, i) - v;
    const Lanes squared = off_u * off_u + off_v * off_v;
    // Eigen's root of four floats is an estimate that differs between processors.
    const Lanes root = squared.max(kTiny).unaryExpr([](float value) { return std::sqrt(value); });
    const Lanes fraction = (knee_f / root).min(1);  // of the pair's influence that is left
    const Lanes weight = counts * fraction;

    const Lanes s = weight * inverse_depth * inverse_depth;
    const Lanes sx = s * x, sy = s * y;
    const LaneSums::Products products{sx * x, sx * y, sx, sy * y, sy, s};
    for (std::size_t k = 0; k < products.size(); ++k) sums.plain[k] += products[k];
    addProducts(products, u, sums.by_u);
    addProducts(products, v, sums.by_v);
    addProducts(products, u * u + v * v, sums.by_uv);

    const Lanes pull_u = weight * inverse_depth * off_u, pull_v = weight * inverse_depth * off_v;
    const Lanes pull_depth = -(u * pull_u + v * pull_v);
    const std::array<Lanes, 8> pull{pull_u * x, pull_u * y, pull_u,         pull_v * x,
                                    pull_v * y, pull_v,     pull_depth * x, pull_depth * y};
    for (std::size_t k = 0; k < pull.size(); ++k) sums.gradient[k] += pull[k];

    // Huber's cost, r^2 / 2 up to the knee k and k (r - k / 2) beyond: with k = fraction r there.
    sums.cost += counts * fraction * (1 - 0.5F * fraction) * squared;
    sums.influence_squares += counts * fraction * fraction * squared;
    sums.weights += weight;
    // Beyond the knee the influence keeps its length: it only turns with the residual's direction.
    sums.slopes += counts * (fraction < 1).select(0.5F * fraction, Lanes::Ones());
  }
  return assemble(sums);
}

}  // namespace redbee
