#include "redbee/visual/normal_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace redbee {
namespace {

constexpr double kKnee = 0.01;

Eigen::Matrix3d tilted() {
  Eigen::Matrix3d H;
  H << 1.02, 0.03, -0.05, -0.02, 0.97, 0.04, 0.05, -0.08, 1;
  return H;
}

/// Off by as much as the knee, some less, some more.
ScaledPairs disturbedPairs(int count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> place(-1, 1), error(-2 * kKnee, 2 * kKnee);
  ScaledPairs pairs;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d a(place(generator), place(generator));
    const Eigen::Vector2d b = transfer(tilted(), a);
    pairs.append(static_cast<float>(a.x()), static_cast<float>(a.y()),
                 static_cast<float>(b.x()) + error(generator), static_cast<float>(b.y()) + error(generator));
  }
  return pairs;
}

/// Textbook implementation, pair by pair.
NormalEquations summed(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen) {
  NormalEquations sum;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!chosen[i]) continue;
    const Eigen::Vector2d residual = pairs.current(i) - transfer(tilted(), pairs.previous(i));
    const Eigen::Matrix<double, 2, 8> J = transferJacobian(tilted(), pairs.previous(i));
    const double r = residual.norm();
    const bool beyond = r > kKnee;
    const double weight = beyond ? kKnee / r : 1;
    sum.information += weight * J.transpose() * J;
    sum.gradient += weight * J.transpose() * residual;
    sum.cost += beyond ? kKnee * (r - 0.5 * kKnee) : 0.5 * r * r;
    sum.influence_squares += weight * weight * r * r;
    sum.weights += weight;
    sum.slopes += beyond ? 0.5 * weight : 1;
  }
  return sum;
}

TEST(NormalEquations, AreTheSumsOverTheChosenPairs) {
  for (const int count : {9, 12, 250}) {  // 9 and 250: the last group of four is not full
    const ScaledPairs pairs = disturbedPairs(count);
    std::vector<uint8_t> chosen(pairs.size(), 1);
    chosen.at(1) = 0;
    const NormalEquations expected = summed(pairs, chosen);
    const PackedPairs packed(pairs, chosen);
    const NormalEquations found = packed.linearise(tilted(), kKnee);
    EXPECT_EQ(packed.size(), count - 1);
    EXPECT_LT(expected.weights, count - 1.5) << "some pairs must lie beyond the knee";
    EXPECT_TRUE(found.information.isApprox(expected.information, 1e-5));
    EXPECT_TRUE(found.gradient.isApprox(expected.gradient, 1e-4));
    EXPECT_NEAR(found.cost, expected.cost, 1e-4 * expected.cost);
    EXPECT_NEAR(found.influence_squares, expected.influence_squares, 1e-4 * expected.influence_squares);
    EXPECT_NEAR(found.weights, expected.weights, 1e-4 * expected.weights);
    EXPECT_NEAR(found.slopes, expected.slopes, 1e-4 * expected.slopes);
  }
}

TEST(NormalEquations, APairWithoutErrorHasFullWeight) {
  ScaledPairs pairs;
  pairs.append(0.2F, -0.3F, 0.2F, -0.3F);
  const NormalEquations found = PackedPairs(pairs, {1}).linearise(Eigen::Matrix3d::Identity(), kKnee);
  EXPECT_EQ(found.weights, 1);
  EXPECT_EQ(found.cost, 0);
  EXPECT_TRUE(found.gradient.isZero());
}

}  // namespace
}  // namespace redbee
