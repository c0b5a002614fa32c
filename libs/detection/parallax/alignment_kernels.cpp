#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/alignment_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/detection/parallax/alignment_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSubpixels = 32;
constexpr double kFarAway = 1e6;  // px: outside of every image

/// Where pixels come from: the nearest pixels' x, their y, then x and y in units of 1 / kSubpixels px.
template <typename D>
HWY_INLINE void places(D d, const double* back, const AlignedRow& row, int x) {
  const hn::Rebind<int32_t, D> integers;
  const auto u = hn::Add(hn::Set(d, x), hn::Iota(d, 0.0));
  const auto mapped = [&](const double* H) HWY_ATTR {
    return hn::Add(hn::Mul(hn::Set(d, H[0]), u), hn::Set(d, H[1] * row.y + H[2]));
  };
  const auto w = mapped(back + 6), at_x = mapped(back), at_y = mapped(back + 3);
  const auto is_nowhere = hn::Eq(w, hn::Zero(d));
  const auto limit = hn::Set(d, kFarAway * kSubpixels);
  const int pixels = row.end - row.begin;
  int32_t* to = row.places + (x - row.begin);
  for (const double unit : {1.0, static_cast<double>(kSubpixels)}) {
    const auto scale = hn::IfThenZeroElse(is_nowhere, hn::Div(hn::Set(d, unit), w));
    const auto rounded = [&](auto at) HWY_ATTR {
      return hn::DemoteTo(integers, hn::Round(hn::Max(hn::Min(hn::Mul(at, scale), limit), hn::Neg(limit))));
    };
    hn::StoreU(rounded(at_x), integers, to);
    hn::StoreU(rounded(at_y), integers, to + pixels);
    to += 2 * pixels;
  }
}

HWY_INLINE uint8_t blend(int right, int below, int p00, int p01, int p10, int p11) {
  constexpr int kHalf = kSubpixels * kSubpixels / 2;
  const int upper = kSubpixels * p00 + right * (p01 - p00), lower = kSubpixels * p10 + right * (p11 - p10);
  return static_cast<uint8_t>((kSubpixels * upper + below * (lower - upper) + kHalf) >> 10);
}

HWY_INLINE uint8_t interpolated(const EarlierImage& image, int x32, int y32) {
  const int x = x32 >> 5, y = y32 >> 5, right = x32 & (kSubpixels - 1), below = y32 & (kSubpixels - 1);
  if (static_cast<unsigned>(x) < static_cast<unsigned>(image.width - 1) &&
      static_cast<unsigned>(y) < static_cast<unsigned>(image.height - 1)) {
    const uint8_t* top = image.pixels + static_cast<ptrdiff_t>(y) * static_cast<ptrdiff_t>(image.stride) + x;
    const uint8_t* bottom = top + image.stride;
    return blend(right, below, top[0], top[1], bottom[0], bottom[1]);
  }
  const auto pixel = [&](int u, int v) -> int {
    const bool is_inside = u >= 0 && v >= 0 && u < image.width && v < image.height;
    return is_inside ? image.pixels[static_cast<size_t>(v) * image.stride + static_cast<size_t>(u)] : 0;
  };
  return blend(right, below, pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1));
}

void align(const EarlierImage& image, const double* back, const AlignedRow& row) {
  const hn::ScalableTag<double> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int at = row.begin;
  for (; at + lanes <= row.end; at += lanes) places(d, back, row, at);
  for (; at < row.end; ++at) places(hn::CappedTag<double, 1>(), back, row, at);
  const int pixels = row.end - row.begin;
  const int32_t* x = row.places;
  const int32_t* y = x + pixels;
  for (int i = 0; i < pixels; ++i) {
    const bool is_inside = (static_cast<unsigned>(x[i]) < static_cast<unsigned>(image.width)) &
                           (static_cast<unsigned>(y[i]) < static_cast<unsigned>(image.height));
    row.unknown[row.begin + i] = is_inside ? 0 : 255;
  }
  x += 2 * pixels;
  y += 2 * pixels;
  for (int i = 0; i < pixels; ++i) row.grey[row.begin + i] = interpolated(image, x[i], y[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(align);

void alignRow(const EarlierImage& image, const double back[9], const AlignedRow& row) {
  HWY_DYNAMIC_DISPATCH(align)(image, back, row);
}

}  // namespace redbee
#endif
