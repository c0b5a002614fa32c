// A homography's covariance in pixels of the image.
#pragma once

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Standard deviation [px] of where `H` takes a point, RMS over a grid of the image. Both scaled.
double transferSigma(const Eigen::Matrix3d& H, const Matrix8d& covariance, int width, int height);

}  // namespace redbee
