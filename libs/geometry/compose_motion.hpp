#pragma once

#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Motion from a to c: first `ba`, then `cb`. The plane is that of `ba`.
PlaneMotion compose(const PlaneMotion& cb, const PlaneMotion& ba);

}  // namespace redbee
