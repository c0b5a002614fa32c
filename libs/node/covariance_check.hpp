// Whether numbers can be a covariance. For message_check.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/node/message_limits.hpp"

namespace redbee::message_limits {

/// Symmetric and positive semidefinite, but for rounding.
template <size_t kEntries>
bool isCovariance(const double (&entries)[kEntries]) {
  constexpr int kSize = kEntries == 64 ? 8 : 3;
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

/// The same of two rows, of which every target has two: without a decomposition.
inline bool isCovariance(const double (&entries)[4]) {
  if (!areFrom(-kMaxSigma * kMaxSigma, entries, kMaxSigma * kMaxSigma)) return false;
  const auto [low, high] = std::minmax(entries[0], entries[3]);
  const double rounding = 1e-9 * std::max(std::abs(low), std::abs(high));
  if (std::abs(entries[1] - entries[2]) > rounding || low < -rounding) return false;
  if (high <= 0) return entries[1] == 0;
  return low - entries[1] * entries[2] / high >= -rounding;
}

}  // namespace redbee::message_limits
