#pragma once

#include <optional>

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Motion from a to c: first `ba`, then `cb`. The plane is that of `ba`.
PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba);
/// Known only where both are.
std::optional<PlaneMotion> compose(const std::optional<PlaneMotion>& cb,
                                   const std::optional<PlaneMotion>& ba);
/// The same of homographies; h33 = 1.
std::optional<Eigen::Matrix3d> composeHomographies(const std::optional<Eigen::Matrix3d>& cb,
                                                   const std::optional<Eigen::Matrix3d>& ba);

}  // namespace redbee
