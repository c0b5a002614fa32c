// A homography with its covariance, and operations on both.
#pragma once

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/homography_quality.hpp"

namespace redbee {

/// In the units of the filter (HomographyFusion); h33 = 1.
struct Estimate {
  Eigen::Matrix3d H;
  Matrix8d P;
};

/// Identity with zero covariance.
Estimate identityEstimate();

Matrix8d symmetric(const Matrix8d& P);
/// J P J'.
Matrix8d transformed(const Matrix8d& J, const Matrix8d& P);

bool isCovariance(const Matrix8d& P);
inline bool isUsable(const Estimate& estimate) { return isUsable(estimate.H) && isCovariance(estimate.P); }

/// `first`, then `second`; their errors are taken as independent.
Estimate composed(const Estimate& second, const Estimate& first);
/// whole first^-1: the part of `whole` after `first`; their errors are taken as independent.
Estimate remainder(const Estimate& whole, const Estimate& first);

}  // namespace redbee
