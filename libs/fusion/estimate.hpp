// A homography with its covariance, and operations on both.
#pragma once

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// In the units that the filter works in (HomographyFusion); h33 = 1.
struct Estimate {
  Eigen::Matrix3d H;
  Matrix8d P;
};

/// No motion, no error.
Estimate identityEstimate();

Matrix8d symmetric(const Matrix8d& P);
/// J P J'.
Matrix8d transformed(const Matrix8d& J, const Matrix8d& P);

/// Neither NaN nor a mirror image nor a collapse of the image.
bool isUsable(const Eigen::Matrix3d& H);
bool isCovariance(const Matrix8d& P);
inline bool isUsable(const Estimate& estimate) { return isUsable(estimate.H) && isCovariance(estimate.P); }

/// `first`, then `second`, their errors independent.
Estimate composed(const Estimate& second, const Estimate& first);
/// The part of `whole` that comes after `first`, their errors independent: whole first^-1.
Estimate remainder(const Estimate& whole, const Estimate& first);

}  // namespace redbee
