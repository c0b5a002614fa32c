#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/imaging/guided_filter_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/imaging/for_lanes.hpp"
#include "redbee/imaging/guided_filter_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The window's sides of the default settings have loops of known length.
template <int known_side>
HWY_INLINE void boxMeanOf(const BoxRow& row) {
  const int side = known_side > 0 ? known_side : row.side;
  const auto radius = static_cast<size_t>(side / 2);
  const size_t width = row.width;
  double* const inner = row.sums + radius;
  forLanes<double>(width, [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(d)> narrow;
    auto sum = hn::LoadU(d, inner + i);
    if (row.leaving != nullptr) sum = hn::Sub(sum, hn::PromoteTo(d, hn::LoadU(narrow, row.leaving + i)));
    hn::StoreU(hn::Add(sum, hn::PromoteTo(d, hn::LoadU(narrow, row.entering + i))), d, inner + i);
  });
  if (row.mean == nullptr) return;
  for (size_t i = 1; i <= radius; ++i) {
    row.sums[radius - i] = inner[i];
    inner[width - 1 + i] = inner[width - 1 - i];
  }
  const double scale = 1.0 / (side * side);
  forLanes<double>(width, [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(d)> narrow;
    auto sum = hn::LoadU(d, row.sums + i);
    for (int k = 1; k < side; ++k) sum = hn::Add(sum, hn::LoadU(d, row.sums + i + k));
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(sum, hn::Set(d, scale))), narrow, row.mean + i);
  });
}

void boxMean(const BoxRow& row) {
  if (row.side == 7) return boxMeanOf<7>(row);
  if (row.side == 5) return boxMeanOf<5>(row);
  boxMeanOf<0>(row);
}

void linearModel(const LinearModelRow& row, float contrast2) {
  forLanes<float>(row.width, [&](auto d, size_t i) HWY_ATTR {
    const auto guide = hn::LoadU(d, row.guide + i), map = hn::LoadU(d, row.map + i);
    const auto variance = hn::Sub(hn::LoadU(d, row.guide_guide + i), hn::Mul(guide, guide));
    const auto covariance = hn::Sub(hn::LoadU(d, row.guide_map + i), hn::Mul(guide, map));
    const auto slope = hn::Div(covariance, hn::Add(variance, hn::Set(d, contrast2)));
    hn::StoreU(slope, d, row.slope + i);
    hn::StoreU(hn::Sub(map, hn::Mul(slope, guide)), d, row.offset + i);
  });
}

void applyModel(const float* slope, const float* offset, const float* guide, size_t width, float* to) {
  forLanes<float>(width, [&](auto d, size_t i) HWY_ATTR {
    hn::StoreU(hn::Add(hn::Mul(hn::LoadU(d, slope + i), hn::LoadU(d, guide + i)), hn::LoadU(d, offset + i)),
               d, to + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(boxMean);
HWY_EXPORT(linearModel);
HWY_EXPORT(applyModel);

void boxMeanRow(const BoxRow& row) { HWY_DYNAMIC_DISPATCH(boxMean)(row); }
void linearModelRow(const LinearModelRow& row, float contrast2) {
  HWY_DYNAMIC_DISPATCH(linearModel)(row, contrast2);
}
void applyModelRow(const float* slope, const float* offset, const float* guide, size_t width, float* to) {
  HWY_DYNAMIC_DISPATCH(applyModel)(slope, offset, guide, width, to);
}

}  // namespace redbee
#endif
