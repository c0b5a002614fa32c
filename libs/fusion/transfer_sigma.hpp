// A homography's covariance as a standard deviation in pixels.
#pragma once

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Standard deviation [px] of the points mapped by `H`, RMS over a grid of the image. `H` and `covariance`:
/// scaled.
double transferSigma(const Eigen::Matrix3d& H, const Matrix8d& covariance, int width, int height);

}  // namespace redbee
