#include "redbee/fusion/estimate.hpp"

#include <Eigen/LU>

#include "redbee/geometry/products.hpp"
#include "redbee/geometry/small_decompositions.hpp"

namespace redbee {

Estimate identityEstimate() { return {Eigen::Matrix3d::Identity(), Matrix8d::Zero()}; }

Matrix8d symmetric(const Matrix8d& P) { return 0.5 * (P + P.transpose()); }

Matrix8d transformed(const Matrix8d& J, const Matrix8d& P) { return symmetric(mappedCovariance(J, P)); }

bool isCovariance(const Matrix8d& P) {
  if (!P.allFinite() || P.diagonal().minCoeff() < 0) return false;
  const LdltFactors factors(symmetric(P));
  return factors.succeeded() && factors.smallestPivot() > -1e-12 * (1 + P.trace());
}

Estimate composed(const Estimate& second, const Estimate& first) {
  const ComposeJacobians J = composeJacobians(second.H, first.H);
  return {normaliseHomography(second.H * first.H),
          transformed(J.by_left, second.P) + transformed(J.by_right, first.P)};
}

Estimate remainder(const Estimate& whole, const Estimate& first) {
  const Eigen::Matrix3d back = normaliseHomography(first.H.inverse());
  const ComposeJacobians J = composeJacobians(whole.H, back);
  return {
      normaliseHomography(whole.H * back),
      transformed(J.by_left, whole.P) + transformed(product(J.by_right, inverseJacobian(first.H)), first.P)};
}

}  // namespace redbee
