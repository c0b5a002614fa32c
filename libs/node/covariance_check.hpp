// Whether numbers can be a covariance. For message_check.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/node/message_limits.hpp"

namespace redbee::message_limits {

/// Symmetric and positive semidefinite, but for rounding.
template <size_t kEntries>
bool isCovariance(const double (&entries)[kEntries]) {
  constexpr int kSize = kEntries == 64 ? 8 : kEntries == 9 ? 3 : 2;
  if (!areFrom(-kMaxSigma * kMaxSigma, entries, kMaxSigma * kMaxSigma)) return false;
  Matrix8d P = Matrix8d::Zero();
  P.topLeftCorner<kSize, kSize>() =
      Eigen::Map<const Eigen::Matrix<double, kSize, kSize, Eigen::RowMajor>>(entries);
  const double rounding = 1e-9 * P.diagonal().cwiseAbs().maxCoeff();
  if ((P - P.transpose()).cwiseAbs().maxCoeff() > rounding || P.diagonal().minCoeff() < -rounding)
    return false;
  const LdltFactors factors(P);
  return factors.succeeded() && factors.smallestPivot() >= -rounding;
}

}  // namespace redbee::message_limits
