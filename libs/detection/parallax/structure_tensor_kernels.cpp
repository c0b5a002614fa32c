#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/structure_tensor_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/detection/parallax/structure_tensor_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void smoothRows(const uint8_t* const rows[3], size_t width, int16_t* smooth, int16_t* difference) {
  forLanes<int16_t>(width, [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<uint8_t, decltype(d)> narrow;
    const auto above = hn::PromoteTo(d, hn::LoadU(narrow, rows[0] + i));
    const auto here = hn::PromoteTo(d, hn::LoadU(narrow, rows[1] + i));
    const auto below = hn::PromoteTo(d, hn::LoadU(narrow, rows[2] + i));
    hn::StoreU(hn::Add(hn::Add(above, below), hn::Add(here, here)), d, smooth + i);
    hn::StoreU(hn::Sub(below, above), d, difference + i);
  });
}

void slideColumns(const int16_t* smooth, const int16_t* difference, size_t width,
                  const TensorColumns& columns) {
  forLanes<int32_t>(width, [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<int16_t, decltype(d)> narrow;
    const auto wide = [&](const int16_t* from) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(narrow, from)); };
    const auto middle = wide(difference + i);
    const auto gx = hn::Sub(wide(smooth + i + 1), wide(smooth + i - 1));
    const auto gy =
        hn::Add(hn::Add(wide(difference + i - 1), wide(difference + i + 1)), hn::Add(middle, middle));
    const auto slide = [&](size_t entry, auto product) HWY_ATTR {
      int32_t* const sum = columns.sums + entry * columns.stride + i;
      int32_t* const kept = columns.products + entry * columns.stride + i;
      hn::StoreU(hn::Add(hn::LoadU(d, sum), hn::Sub(product, hn::LoadU(d, kept))), d, sum);
      hn::StoreU(product, d, kept);
    };
    slide(0, hn::Mul(gx, gx));
    slide(1, hn::Mul(gx, gy));
    slide(2, hn::Mul(gy, gy));
  });
}

template <int known_side>
HWY_INLINE void sumRowOf(const int32_t* sums, size_t stride, int any_side, double scale, size_t width,
                         float* tensor) {
  const int side = known_side > 0 ? known_side : any_side;
  forLanes<double>(width, [&](auto d, size_t i) HWY_ATTR {
    const hn::Rebind<int32_t, decltype(d)> integers;
    const hn::Rebind<float, decltype(d)> narrow;
    const auto total = [&](size_t entry) HWY_ATTR {
      const int32_t* const from = sums + entry * stride + i;
      auto sum = hn::LoadU(integers, from);
      for (int k = 1; k < side; ++k) sum = hn::Add(sum, hn::LoadU(integers, from + k));
      return hn::DemoteTo(narrow, hn::Mul(hn::PromoteTo(d, sum), hn::Set(d, scale)));
    };
    hn::StoreInterleaved3(total(0), total(1), total(2), narrow, tensor + 3 * i);
  });
}

void sumRow(const int32_t* sums, size_t stride, int side, double scale, size_t width, float* tensor) {
  if (side == 7) return sumRowOf<7>(sums, stride, side, scale, width, tensor);
  if (side == 3) return sumRowOf<3>(sums, stride, side, scale, width, tensor);
  sumRowOf<0>(sums, stride, side, scale, width, tensor);
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(smoothRows);
HWY_EXPORT(slideColumns);
HWY_EXPORT(sumRow);

void smoothAndDifference(const uint8_t* const rows[3], size_t width, int16_t* smooth, int16_t* difference) {
  HWY_DYNAMIC_DISPATCH(smoothRows)(rows, width, smooth, difference);
}
void slideTensorColumns(const int16_t* smooth, const int16_t* difference, size_t width,
                        const TensorColumns& columns) {
  HWY_DYNAMIC_DISPATCH(slideColumns)(smooth, difference, width, columns);
}
void sumTensorRow(const int32_t* sums, size_t stride, int side, double scale, size_t width, float* tensor) {
  HWY_DYNAMIC_DISPATCH(sumRow)(sums, stride, side, scale, width, tensor);
}

}  // namespace redbee
#endif
