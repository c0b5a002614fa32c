// What is compiled once for all: products as Eigen gives them, to the bit; decompositions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/products.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

using Matrix24d = Eigen::Matrix<double, 24, 24>;
using Matrix15d = Eigen::Matrix<double, 15, 15>;
using Matrix324d = Eigen::Matrix<double, 3, 24>;

constexpr int kRuns = 20;

template <typename Matrix>
Matrix covariance() {
  const Matrix root = Matrix::Random();
  return root * root.transpose();
}

TEST(Products, AreEigens) {
  for (int i = 0; i < kRuns; ++i) {
    const Matrix15d F = Matrix15d::Random(), Q = Matrix15d::Random(), P = covariance<Matrix15d>();
    const Matrix15d mapped = F * P * F.transpose();
    const Matrix15d sum = F * P * F.transpose() + Q;
    EXPECT_EQ(mappedCovariance(F, P), mapped);
    EXPECT_EQ(Matrix15d(mappedCovariancePlus(F, P, Q)), sum);
  }
}

TEST(Products, OfARectangularMatrixAreEigens) {
  for (int i = 0; i < kRuns; ++i) {
    const Matrix324d H = Matrix324d::Random();
    const Matrix24d P = covariance<Matrix24d>();
    const Eigen::Matrix3d R = covariance<Eigen::Matrix3d>();
    const Eigen::Matrix3d inverse = (H * P * H.transpose() + R).inverse();
    EXPECT_EQ(Eigen::Matrix3d(mappedCovariancePlus(H, P, R).inverse()), inverse);
  }
}

TEST(TransferCovariance, IsEigensProductWithinASum) {
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::Matrix<double, 2, 8> J = Eigen::Matrix<double, 2, 8>::Random();
    const Matrix8d P = covariance<Matrix8d>();
    const Eigen::Matrix2d sum = J * P * J.transpose() + Eigen::Matrix2d::Identity();
    EXPECT_EQ(Eigen::Matrix2d(transferCovariance(J, P) + Eigen::Matrix2d::Identity()), sum);
  }
}

TEST(SmallestEigenvalue, IsTheSmallerRootOfTheCharacteristicPolynomial) {
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::Matrix2d M = (i + 1) * covariance<Eigen::Matrix2d>();
    const double root = std::hypot(M(0, 0) - M(1, 1), 2 * M(0, 1));
    EXPECT_NEAR(smallestEigenvalue(M), 0.5 * (M.trace() - root), 1e-12 * M.trace());
  }
  EXPECT_EQ(smallestEigenvalue(Eigen::Matrix2d::Zero()), 0);
}

TEST(LdltFactors, RefuseAnIndefiniteMatrix) {
  Matrix8d M = Matrix8d::Identity();
  EXPECT_TRUE(LdltFactors(M).isPositive());
  M(7, 7) = -1;
  EXPECT_FALSE(LdltFactors(M).isPositive());
  EXPECT_EQ(LdltFactors(M).smallestPivot(), -1);
}

TEST(RotationBetween, IsTheSmallestRotation) {
  for (int i = 0; i < kRuns; ++i) {
    const Eigen::Vector3d from = Eigen::Vector3d::Random(), to = Eigen::Vector3d::Random();
    const Eigen::Quaterniond q = rotationBetween(from, to);
    EXPECT_LT((q * from.normalized() - to.normalized()).norm(), 1e-12);
    EXPECT_LT(std::abs(q.vec().dot(from)) + std::abs(q.vec().dot(to)), 1e-12);
  }
}

TEST(RotationBetween, TurnsOppositeDirectionsByHalfATurn) {
  const Eigen::Vector3d down(0, 0, -2);
  const Eigen::Quaterniond q = rotationBetween(down, Eigen::Vector3d::UnitZ());
  EXPECT_LT((q * down - Eigen::Vector3d(0, 0, 2)).norm(), 1e-12);
  EXPECT_NEAR(q.norm(), 1, 1e-12);
}

}  // namespace
}  // namespace redbee
