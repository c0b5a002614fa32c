// How much two frames have in common.
#pragma once

#include <Eigen/Core>

namespace redbee {

/// Share of a frame's area that `H` [px] takes into the other frame; both of this size [px].
double overlap(const Eigen::Matrix3d& H, int width, int height);

}  // namespace redbee
