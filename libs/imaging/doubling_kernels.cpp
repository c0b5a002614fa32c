#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/imaging/doubling_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/imaging/doubling_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void across(const uint8_t* row, int width, uint16_t* to) {
  const auto scalar = [&](int x) {
    const int three = 3 * row[x];
    to[2 * x] = static_cast<uint16_t>(three + row[std::max(x - 1, 0)]);
    to[2 * x + 1] = static_cast<uint16_t>(three + row[std::min(x + 1, width - 1)]);
  };
  scalar(0);
  if (width < 2) return;
  forLanes<uint16_t>(static_cast<size_t>(width - 2), [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<uint8_t, decltype(d)> bytes;
    const auto at = [&](size_t x) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(bytes, row + x)); };
    const auto own = at(i + 1), three = hn::Add(own, hn::Add(own, own));
    hn::StoreInterleaved2(hn::Add(three, at(i)), hn::Add(three, at(i + 2)), d, to + 2 * (i + 1));
  });
  scalar(width - 1);
}

void mix(const uint16_t* near, const uint16_t* far, int width, uint8_t* to) {
  forLanes<uint16_t>(static_cast<size_t>(width), [&](auto d, size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(d)> with_sign;
    const hn::Rebind<uint8_t, decltype(d)> bytes;
    const auto own = hn::LoadU(d, near + i);
    const auto three_quarters = hn::ShiftRight<2>(hn::Add(own, hn::Add(own, own)));
    const auto quarter = hn::ShiftRight<2>(hn::LoadU(d, far + i));
    const auto sum = hn::Add(hn::Add(three_quarters, quarter), hn::Set(d, uint16_t{2}));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(with_sign, hn::ShiftRight<2>(sum))), bytes, to + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(across);
HWY_EXPORT(mix);

void doubleAcross(const uint8_t* row, int width, uint16_t* to) {
  HWY_DYNAMIC_DISPATCH(across)(row, width, to);
}
void mixRows(const uint16_t* near, const uint16_t* far, int width, uint8_t* to) {
  HWY_DYNAMIC_DISPATCH(mix)(near, far, width, to);
}

}  // namespace redbee
#endif
