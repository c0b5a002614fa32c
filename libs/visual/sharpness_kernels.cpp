#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/visual/sharpness_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/visual/sharpness_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename Pixels>
struct RowSums {
  hn::VFromD<hn::RepartitionToWide<Pixels>> xx, xy, yy;
};

/// Of the pixels from column x on.
template <typename Pixels>
HWY_INLINE void add(Pixels d, const uint8_t* const rows[3], size_t x, RowSums<Pixels>& sums) {
  const hn::RepartitionToWide<Pixels> wide;
  const hn::Rebind<uint8_t, Pixels> narrow;
  const auto load = [&](int row, size_t column)
                        HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(narrow, rows[row] + column)); };
  const auto twice = [](auto value) HWY_ATTR { return hn::Add(value, value); };
  const auto above_left = load(0, x - 1), above_right = load(0, x + 1), below_left = load(2, x - 1),
             below_right = load(2, x + 1);
  const auto across = twice(hn::Sub(load(1, x + 1), load(1, x - 1)));
  const auto down = twice(hn::Sub(load(2, x), load(0, x)));
  const auto falling = hn::Sub(below_right, above_left), rising = hn::Sub(above_right, below_left);
  const auto gx = hn::Add(hn::Add(falling, rising), across);
  const auto gy = hn::Add(hn::Sub(falling, rising), down);
  const auto products = [&](auto a, auto b, auto& sum) HWY_ATTR {
    auto second = hn::Zero(wide);
    sum = hn::ReorderWidenMulAccumulate(wide, a, b, sum, second);
    sum = hn::Add(sum, second);
  };
  products(gx, gx, sums.xx);
  products(gx, gy, sums.xy);
  products(gy, gy, sums.yy);
}

GradientProducts ofRow(const uint8_t* const rows[3], size_t width) {
  const hn::ScalableTag<int16_t> d;
  const hn::CappedTag<int16_t, 4> four;
  GradientProducts total{0, 0, 0};
  const auto addTo = [&](auto tag, size_t& x, size_t step) HWY_ATTR {
    const hn::RepartitionToWide<decltype(tag)> wide;
    RowSums<decltype(tag)> sums{hn::Zero(wide), hn::Zero(wide), hn::Zero(wide)};
    for (; x + step <= width - 1; x += step) add(tag, rows, x, sums);
    total.xx += hn::GetLane(hn::SumOfLanes(wide, sums.xx));
    total.xy += hn::GetLane(hn::SumOfLanes(wide, sums.xy));
    total.yy += hn::GetLane(hn::SumOfLanes(wide, sums.yy));
  };
  size_t x = 1;
  addTo(d, x, hn::Lanes(d));
  addTo(four, x, hn::Lanes(four));
  for (; x + 1 < width; ++x) {
    const int falling = rows[2][x + 1] - rows[0][x - 1], rising = rows[0][x + 1] - rows[2][x - 1];
    const int gx = falling + rising + 2 * (rows[1][x + 1] - rows[1][x - 1]);
    const int gy = falling - rising + 2 * (rows[2][x] - rows[0][x]);
    total.xx += gx * gx;
    total.xy += gx * gy;
    total.yy += gy * gy;
  }
  return total;
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(ofRow);

GradientProducts gradientProducts(const uint8_t* const rows[3], size_t width) {
  return HWY_DYNAMIC_DISPATCH(ofRow)(rows, width);
}

}  // namespace redbee
#endif
