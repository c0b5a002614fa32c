#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/alignment_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdlib>

#include "redbee/detection/parallax/alignment_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSubpixels = 32;
constexpr double kFarAway = 1e6;  // px: outside of every image

/// Where pixels come from, in units of 1 / `unit` px.
template <typename D>
HWY_INLINE void places(D d, const double* back, int y, int x, double unit, int32_t* to_x, int32_t* to_y) {
  const hn::Rebind<int32_t, D> integers;
  const auto u = hn::Add(hn::Set(d, x), hn::Iota(d, 0.0));
  const auto mapped = [&](const double* H) HWY_ATTR {
    return hn::Add(hn::Mul(hn::Set(d, H[0]), u), hn::Set(d, H[1] * y + H[2]));
  };
  const auto w = mapped(back + 6);
  const auto is_nowhere = hn::Eq(w, hn::Zero(d));
  const auto limit = hn::Set(d, kFarAway * kSubpixels);
  const auto scale = hn::IfThenZeroElse(is_nowhere, hn::Div(hn::Set(d, unit), w));
  const auto rounded = [&](auto at) HWY_ATTR {
    return hn::DemoteTo(integers, hn::Round(hn::Max(hn::Min(hn::Mul(at, scale), limit), hn::Neg(limit))));
  };
  hn::StoreU(rounded(mapped(back)), integers, to_x);
  hn::StoreU(rounded(mapped(back + 3)), integers, to_y);
}

/// Of all pixels of the row: the x of their places in row.places, and y behind them.
HWY_INLINE void placesOfRow(const double* back, const AlignedRow& row, double unit) {
  const hn::ScalableTag<double> d;
  const int lanes = static_cast<int>(hn::Lanes(d)), pixels = row.end - row.begin;
  int i = 0;
  for (; i + lanes <= pixels; i += lanes)
    places(d, back, row.y, row.begin + i, unit, row.places + i, row.places + pixels + i);
  for (; i < pixels; ++i)
    places(hn::CappedTag<double, 1>(), back, row.y, row.begin + i, unit, row.places + i,
           row.places + pixels + i);
}

/// Whether the nearest pixel of where a pixel comes from is in the image.
HWY_INLINE bool isShown(const EarlierImage& image, const double* back, int y, int x) {
  int32_t at_x = 0, at_y = 0;
  places(hn::CappedTag<double, 1>(), back, y, x, 1, &at_x, &at_y);
  return at_x >= 0 && at_y >= 0 && at_x < image.width && at_y < image.height;
}

/// `shown` is, `hidden` is not, and between the two this changes once: the shown pixel next to the change.
HWY_INLINE int lastShown(const EarlierImage& image, const double* back, int y, int shown, int hidden) {
  while (std::abs(hidden - shown) > 1) {
    const int between = (shown + hidden) / 2;
    (isShown(image, back, y, between) ? shown : hidden) = between;
  }
  return shown;
}

/// True if the places of the row's pixels go in one direction, which they do unless a pole lies between.
HWY_INLINE bool isMonotone(const double* back, const AlignedRow& row) {
  const auto w = [&](int x) HWY_ATTR { return back[6] * x + (back[7] * row.y + back[8]); };
  return w(row.begin) * w(row.end - 1) > 0;
}

/// All of row.unknown, by the ends of what is shown; false, and nothing done, if these do not say it.
HWY_INLINE bool markBetweenEnds(const EarlierImage& image, const double* back, const AlignedRow& row) {
  if (!isMonotone(back, row)) return false;
  const int last = row.end - 1;
  const bool first_shown = isShown(image, back, row.y, row.begin),
             last_shown = isShown(image, back, row.y, last);
  if (!first_shown && !last_shown) return false;
  const int from = first_shown ? row.begin : lastShown(image, back, row.y, last, row.begin);
  const int to = last_shown ? last : lastShown(image, back, row.y, row.begin, last);
  std::fill(row.unknown + row.begin, row.unknown + from, uint8_t{255});
  std::fill(row.unknown + from, row.unknown + to + 1, uint8_t{0});
  std::fill(row.unknown + to + 1, row.unknown + row.end, uint8_t{255});
  return true;
}

HWY_INLINE void markEach(const EarlierImage& image, const double* back, const AlignedRow& row) {
  placesOfRow(back, row, 1);
  const int pixels = row.end - row.begin;
  forLanes<int32_t>(static_cast<size_t>(pixels), [&](auto tag, size_t i) HWY_ATTR {
    const hn::RebindToUnsigned<decltype(tag)> without_sign;
    const auto is_inside = [&](const int32_t* coordinates, int size) HWY_ATTR {
      return hn::Lt(hn::BitCast(without_sign, hn::LoadU(tag, coordinates + i)),
                    hn::Set(without_sign, static_cast<uint32_t>(size)));
    };
    const auto known =
        hn::And(is_inside(row.places, image.width), is_inside(row.places + pixels, image.height));
    const auto value = hn::BitCast(tag, hn::IfThenZeroElse(known, hn::Set(without_sign, 255)));
    const hn::Rebind<uint8_t, decltype(tag)> narrow;
    hn::StoreU(hn::DemoteTo(narrow, value), narrow, row.unknown + row.begin + i);
  });
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
  if (!markBetweenEnds(image, back, row)) markEach(image, back, row);
  placesOfRow(back, row, kSubpixels);
  const int pixels = row.end - row.begin;
  const int32_t* x = row.places;
  const int32_t* y = x + pixels;
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

void alignPixels(const EarlierImage& image, const double back[9], const AlignedRow& row) {
  HWY_DYNAMIC_DISPATCH(align)(image, back, row);
}

}  // namespace redbee
#endif
