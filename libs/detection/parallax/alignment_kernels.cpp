#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/alignment_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/parallax/alignment_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

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

/// interpolated() for as many pixels as there are lanes; false, and nothing done, if one of them needs what
/// lies beyond the border, or the bytes behind the image.
template <typename D>
HWY_INLINE bool interpolate(D d, const EarlierImage& image, const int32_t* x32, const int32_t* y32,
                            uint8_t* to) {
  const hn::RebindToUnsigned<D> without_sign;
  const auto constant = [&](int value) HWY_ATTR { return hn::Set(d, value); };
  const auto x = hn::LoadU(d, x32), y = hn::LoadU(d, y32);
  const auto column = hn::ShiftRight<5>(x), row = hn::ShiftRight<5>(y);
  const auto is_inside = [&](auto at, int size) HWY_ATTR {
    return hn::Lt(hn::BitCast(without_sign, at), hn::Set(without_sign, static_cast<uint32_t>(size)));
  };
  constexpr int kBehind = 3;  // four bytes are read
  if (image.width <= kBehind || image.height <= 1) return false;
  if (!hn::AllTrue(without_sign,
                   hn::And(is_inside(column, image.width - kBehind), is_inside(row, image.height - 1))))
    return false;
  const auto offset = hn::Add(hn::Mul(row, constant(static_cast<int>(image.stride))), column);
  const auto* const top = reinterpret_cast<const int32_t*>(image.pixels);
  const auto* const bottom = reinterpret_cast<const int32_t*>(image.pixels + image.stride);
  const auto right = hn::And(x, constant(kSubpixels - 1)), below = hn::And(y, constant(kSubpixels - 1));
  const auto between = [&](auto pixels) HWY_ATTR {
    const auto first = hn::And(pixels, constant(0xFF));
    const auto second = hn::And(hn::ShiftRight<8>(pixels), constant(0xFF));
    return hn::Add(hn::ShiftLeft<5>(first), hn::Mul(right, hn::Sub(second, first)));
  };
  const auto upper = between(hn::GatherOffset(d, top, offset));
  const auto lower = between(hn::GatherOffset(d, bottom, offset));
  const auto sum = hn::Add(hn::ShiftLeft<5>(upper), hn::Mul(below, hn::Sub(lower, upper)));
  const auto value = hn::ShiftRight<10>(hn::Add(sum, constant(kSubpixels * kSubpixels / 2)));
  const hn::Rebind<uint8_t, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, value), narrow, to);
  return true;
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
  forLanes<int32_t>(static_cast<size_t>(pixels), [&](auto tag, size_t i) HWY_ATTR {
    const hn::RebindToUnsigned<decltype(tag)> without_sign;
    const auto is_inside = [&](const int32_t* coordinates, int size) HWY_ATTR {
      return hn::Lt(hn::BitCast(without_sign, hn::LoadU(tag, coordinates + i)),
                    hn::Set(without_sign, static_cast<uint32_t>(size)));
    };
    const auto known = hn::And(is_inside(x, image.width), is_inside(y, image.height));
    const auto value = hn::BitCast(tag, hn::IfThenZeroElse(known, hn::Set(without_sign, 255)));
    const hn::Rebind<uint8_t, decltype(tag)> narrow;
    hn::StoreU(hn::DemoteTo(narrow, value), narrow, row.unknown + row.begin + i);
  });
  x += 2 * pixels;
  y += 2 * pixels;
  const hn::ScalableTag<int32_t> wide;
  const int together = static_cast<int>(hn::Lanes(wide));
  uint8_t* grey = row.grey + row.begin;
  for (int i = 0; i < pixels;) {
    const int end = std::min(i + together, pixels);
    if (end - i == together && interpolate(wide, image, x + i, y + i, grey + i)) {
      i = end;
      continue;
    }
    for (; i < end; ++i) grey[i] = interpolated(image, x[i], y[i]);
  }
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
