#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/imaging/chamfer_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/imaging/chamfer_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Of the row next to it.
HWY_INLINE void fromRow(const float* beside, const ChamferSteps& steps, int width, float* row) {
  const int last = width - 1;
  const auto atEnd = [&](int x, int inwards) {
    const float inside = width > 1 ? beside[inwards] : steps.beyond;
    row[x] =
        std::min({row[x], beside[x] + steps.beside, steps.beyond + steps.diagonal, inside + steps.diagonal});
  };
  atEnd(0, 1);
  if (width < 2) return;
  forLanes<float>(static_cast<size_t>(last - 1), [&](auto d, size_t i) HWY_ATTR {
    const size_t x = i + 1;
    const auto straight = hn::Add(hn::LoadU(d, beside + x), hn::Set(d, steps.beside));
    const auto diagonal = hn::Add(hn::Min(hn::LoadU(d, beside + x - 1), hn::LoadU(d, beside + x + 1)),
                                  hn::Set(d, steps.diagonal));
    hn::StoreU(hn::Min(hn::LoadU(d, row + x), hn::Min(straight, diagonal)), d, row + x);
  });
  atEnd(last, last - 1);
}

HWY_INLINE void fromBeyond(const ChamferSteps& steps, int width, float* row) {
  for (int x = 0; x < width; ++x) row[x] = std::min(row[x], steps.beyond + steps.beside);
}

void propagate(const DistanceMap& map, const ChamferSteps& steps) {
  const auto rowAt = [&](int y) { return map.values + static_cast<size_t>(y) * map.stride; };
  for (int y = 0; y < map.height; ++y) {
    float* const row = rowAt(y);
    if (y > 0) {
      fromRow(rowAt(y - 1), steps, map.width, row);
    } else {
      fromBeyond(steps, map.width, row);
    }
    float before = steps.beyond;
    for (int x = 0; x < map.width; ++x) row[x] = before = std::min(row[x], before + steps.beside);
  }
  for (int y = map.height - 1; y >= 0; --y) {
    float* const row = rowAt(y);
    if (y < map.height - 1) {
      fromRow(rowAt(y + 1), steps, map.width, row);
    } else {
      fromBeyond(steps, map.width, row);
    }
    float before = steps.beyond;
    for (int x = map.width - 1; x >= 0; --x) row[x] = before = std::min(row[x], before + steps.beside);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(propagate);

void propagateDistances(const DistanceMap& map, const ChamferSteps& steps) {
  HWY_DYNAMIC_DISPATCH(propagate)(map, steps);
}

}  // namespace redbee
#endif
