// The two passes of the chamfer distance, as vector code; chamfer_distance.hpp says what it is.
#pragma once

#include <cstddef>

namespace redbee {

struct DistanceMap {
  float* values;
  size_t stride;  ///< values from one row to the next
  int width, height;
};

/// The least over paths of steps to neighbours, each of which costs `beside` or `diagonal`, of a pixel's
/// value and the path's cost. `beyond`: of the pixels outside of the map.
struct ChamferSteps {
  float beside, diagonal, beyond;
};
void propagateDistances(const DistanceMap& map, const ChamferSteps& steps);

}  // namespace redbee
