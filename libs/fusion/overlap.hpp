// Overlap of two frames.
#pragma once

#include <Eigen/Core>

namespace redbee {

/// Fraction of a frame's area that `H` [px] maps into the other frame; both frames are width x height px.
double overlap(const Eigen::Matrix3d& H, int width, int height);

}  // namespace redbee
