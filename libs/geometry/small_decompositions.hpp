// Decompositions of small matrices that are compiled once, as those of decompositions.hpp.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// L D L' with pivots, of a symmetric matrix over a homography's entries.
class LdltFactors {
 public:
  explicit LdltFactors(const Matrix8d& M);

  bool succeeded() const;
  /// Semidefinite at least.
  bool isPositive() const;
  double smallestPivot() const;
  double reciprocalCondition() const;
  Vector8d solve(const Vector8d& b) const;
  Matrix8d solve(const Matrix8d& B) const;
  Matrix8d inverse() const;

 private:
  Eigen::LDLT<Matrix8d> factors_;
};

/// d' S^-1 d, for S positive definite.
double squaredMahalanobis(const Eigen::Vector2d& d, const Eigen::Matrix2d& S);
double squaredMahalanobis(const Eigen::Vector3d& d, const Eigen::Matrix3d& S);

/// Of a symmetric matrix.
double smallestEigenvalue(const Eigen::Matrix2d& M);

}  // namespace redbee
