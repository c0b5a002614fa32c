#include "redbee/node/covariance_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

namespace redbee::message_limits {
namespace {

/// Two rows are judged without a decomposition: as by their eigenvalues.
TEST(CovarianceCheck, TwoRowsAreACovarianceWhereNoEigenvalueIsNegative) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3000; ++k) {
    const Eigen::Matrix2d A = Eigen::Matrix2d::NullaryExpr([&] { return normal(random); });
    const Eigen::Matrix2d Q = Eigen::HouseholderQR<Eigen::Matrix2d>(A).householderQ();
    const double scale = std::pow(10, k % 7 - 3);
    const double smaller = k % 3 == 0 ? 0.5 : k % 3 == 1 ? 0 : -1e-6;
    const Eigen::Matrix2d P = scale * Q * Eigen::Vector2d(1, smaller).asDiagonal() * Q.transpose();
    double entries[4] = {P(0, 0), P(0, 1), P(0, 1), P(1, 1)};
    EXPECT_EQ(isCovariance(entries), smaller >= 0) << P;
    entries[1] += 1e-6 * scale;
    EXPECT_FALSE(isCovariance(entries)) << "not symmetric";
  }
}

TEST(CovarianceCheck, TwoRowsOfZerosAreOneAndWhatIsNoNumberIsNot) {
  const double nan = std::nan("");
  EXPECT_TRUE(isCovariance({0, 0, 0, 0}));
  EXPECT_TRUE(isCovariance({4, 0, 0, 0}));
  EXPECT_FALSE(isCovariance({0, 1e-9, 1e-9, 0}));
  EXPECT_FALSE(isCovariance({4, 0.1, 0.1, 0}));
  EXPECT_FALSE(isCovariance({-1, 0, 0, -1}));
  EXPECT_FALSE(isCovariance({1, 0, 0, -1}));
  EXPECT_FALSE(isCovariance({1, nan, nan, 1}));
  EXPECT_FALSE(isCovariance({nan, 0, 0, 1}));
  EXPECT_FALSE(isCovariance({1e13, 0, 0, 1}));
}

}  // namespace
}  // namespace redbee::message_limits
