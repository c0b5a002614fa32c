#include "redbee/geometry/small_decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace redbee {

LdltFactors::LdltFactors(const Matrix8d& M) : factors_(M) {}

bool LdltFactors::succeeded() const { return factors_.info() == Eigen::Success; }

bool LdltFactors::isPositive() const { return factors_.isPositive(); }

double LdltFactors::smallestPivot() const { return factors_.vectorD().minCoeff(); }

double LdltFactors::reciprocalCondition() const { return factors_.rcond(); }

Vector8d LdltFactors::solve(const Vector8d& b) const { return factors_.solve(b); }

Matrix8d LdltFactors::solve(const Matrix8d& B) const { return factors_.solve(B); }

Matrix8d LdltFactors::inverse() const { return factors_.solve(Matrix8d::Identity()); }

double squaredMahalanobis(const Eigen::Vector2d& d, const Eigen::Matrix2d& S) {
  return d.dot(S.llt().solve(d));
}

double squaredMahalanobis(const Eigen::Vector3d& d, const Eigen::Matrix3d& S) {
  const Eigen::Matrix3d inverse = S.inverse();
  return d.dot(inverse * d);
}

// What the solver's compute() does, without the reduction to tridiagonal form: a 2x2 matrix has it.
double smallestEigenvalue(const Eigen::Matrix2d& M) {
  using Subdiagonal = Eigen::Matrix<double, 1, 1>;
  const double largest = std::max({std::abs(M(0, 0)), std::abs(M(1, 0)), std::abs(M(1, 1))});
  const double scale = largest > 0 ? largest : 1;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeFromTridiagonal(M.diagonal() / scale, Subdiagonal(M(1, 0) / scale), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) * scale;
}

}  // namespace redbee
