// The inner loop of the patch alignment where the processor has vectors of 32 bytes: two rows at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "redbee/visual/lanes.hpp"

namespace redbee {

/// A patch between pixels, from its top left corner; rows of `lanes` groups of eight.
struct SampledPatch {
  const uint8_t* corner;
  size_t stride;
  int side, lanes;
  BilinearWeights weights;
};

struct PatchProducts {
  int64_t x, y;
};

/// Sums of the samples (kSampleBits) times either gradient, which are stored row by row. False, and nothing
/// done, where vectors are shorter. The sums are exact.
bool sampleProducts(const SampledPatch& patch, const int16_t* gradient_x, const int16_t* gradient_y,
                    PatchProducts& sums);

/// The samples, stored like the gradients; the columns beyond the patch hold what lies beside it.
bool storeSamples(const SampledPatch& patch, int16_t* samples);

}  // namespace redbee
