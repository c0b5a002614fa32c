// Rows of the covariance of dense flow, as vector code; flow_covariance.hpp and structure_tensor.hpp say what
// they are.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// displacementCovariance() of `count` structure tensors; both as xx, xy, yy one after the other.
/// `no_gradient2`: added to the diagonal.
void covariancesOfTensors(const float* tensors, size_t count, float variance, float min_gradient2,
                          float no_gradient2, float* covariances);

/// Where a row of pixels lies in a row of a smaller map: offsets of the entries to the left and to the right,
/// and the weight of the latter.
struct BetweenColumns {
  const int32_t* left;
  const int32_t* right;
  const float* right_weight;
  size_t width;
};
/// Interpolated; xx, xy and yy one row behind the other. `map`: xx, xy, yy interleaved.
void interpolateTensors(const float* map, const BetweenColumns& columns, float* rows);

}  // namespace redbee
