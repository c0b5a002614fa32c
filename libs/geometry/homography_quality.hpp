// Whether a homography and its covariance are of any use.
#pragma once

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// True if H is finite and neither mirrors the image nor collapses it. A camera that has turned away from
/// what it saw has no such homography.
bool isUsable(const Eigen::Matrix3d& H);

/// Whether `covariance` [scaled] says that anything is known: where a step is long, and velocity and height
/// uncertain, the linearised errors exceed any image.
bool isInformative(const Matrix8d& covariance);

}  // namespace redbee
