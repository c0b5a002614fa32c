#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/appearance/background_warp_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/appearance/background_warp_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Four = hn::FixedTag<float, 4>;

/// Written so that what is not a number is outside, too.
HWY_INLINE bool isInside(const WarpedMaps& maps, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(maps.width - 1) &&
         y < static_cast<float>(maps.height - 1);
}

HWY_INLINE void sample(const WarpedMaps& maps, float x, float y, const WarpRun& to, int i) {
  const Four d;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float beyond = x - static_cast<float>(column), below = y - static_cast<float>(row);
  const int at = row * maps.width + column;
  const float* top = maps.model + 4 * static_cast<ptrdiff_t>(at);
  const float* bottom = top + 4 * static_cast<ptrdiff_t>(maps.width);
  const auto along = [&](const float* left) HWY_ATTR {
    const auto from = hn::LoadU(d, left);
    return hn::Add(from, hn::Mul(hn::Set(d, beyond), hn::Sub(hn::LoadU(d, left + 4), from)));
  };
  const auto upper = along(top), lower = along(bottom);
  hn::StoreU(hn::Add(upper, hn::Mul(hn::Set(d, below), hn::Sub(lower, upper))), d, to.model + 4 * i);
  const int nearest = at + (beyond > 0.5F ? 1 : 0) + (below > 0.5F ? maps.width : 0);
  to.age[i] = maps.age[nearest];
  to.speed[i] = maps.speed[nearest];
}

void warpPixels(const WarpedMaps& maps, const WarpRun& run) {
  const auto xOf = [&](int i) { return run.x + static_cast<float>(i) * run.step_x; };
  const auto yOf = [&](int i) { return run.y + static_cast<float>(i) * run.step_y; };
  const int last = run.pixels - 1;
  if (isInside(maps, run.x, run.y) && isInside(maps, xOf(last), yOf(last))) {
    for (int i = 0; i < run.pixels; ++i) sample(maps, xOf(i), yOf(i), run, i);
    return;
  }
  for (int i = 0; i < run.pixels; ++i) {
    if (isInside(maps, xOf(i), yOf(i))) {
      sample(maps, xOf(i), yOf(i), run, i);
    } else {
      std::fill_n(run.model + 4 * i, 4, 0.0F);
      run.speed[i] = 0;
      run.age[i] = 0;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(warpPixels);

void warpRun(const WarpedMaps& maps, const WarpRun& run) { HWY_DYNAMIC_DISPATCH(warpPixels)(maps, run); }

}  // namespace redbee
#endif
