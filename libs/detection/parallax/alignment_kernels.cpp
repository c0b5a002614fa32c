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

/// Where pixels come from, in units of 1 / `unit` px: x of all, then y.
template <typename D>
HWY_INLINE void places(D d, const double* back, double unit, const AlignedRow& row, int x, int32_t* to) {
  const hn::Rebind<int32_t, D> integers;
  const auto u = hn::Add(hn::Set(d, x), hn::Iota(d, 0.0));
  const auto mapped = [&](const double* H) HWY_ATTR {
    return hn::Add(hn::Mul(hn::Set(d, H[0]), u), hn::Set(d, H[1] * row.y + H[2]));
  };
  const auto w = mapped(back + 6);
  const auto scale = hn::IfThenZeroElse(hn::Eq(w, hn::Zero(d)), hn::Div(hn::Set(d, unit), w));
  const auto store = [&](const double* H, int32_t* at) HWY_ATTR {
    const auto limit = hn::Set(d, kFarAway * kSubpixels);
    const auto place = hn::Max(hn::Min(hn::Mul(mapped(H), scale), limit), hn::Neg(limit));
    hn::StoreU(hn::DemoteTo(integers, hn::Round(place)), integers, at);
  };
  store(back, to + (x - row.begin));
  store(back + 3, to + (row.end - row.begin) + (x - row.begin));
}

HWY_INLINE void placesOfRow(const double* back, double unit, const AlignedRow& row) {
  const hn::ScalableTag<double> d;
  int x = row.begin;
  for (; x + static_cast<int>(hn::Lanes(d)) <= row.end; x += static_cast<int>(hn::Lanes(d))) {
    places(d, back, unit, row, x, row.places);
  }
  for (; x < row.end; ++x) places(hn::CappedTag<double, 1>(), back, unit, row, x, row.places);
}

HWY_INLINE uint8_t interpolated(const EarlierImage& image, int x32, int y32) {
  constexpr int kHalf = kSubpixels * kSubpixels / 2;
  const int x = x32 >> 5, y = y32 >> 5, right = x32 & (kSubpixels - 1), below = y32 & (kSubpixels - 1);
  const auto blend = [&](int p00, int p01, int p10, int p11) {
    const int upper = (kSubpixels - right) * p00 + right * p01,
              lower = (kSubpixels - right) * p10 + right * p11;
    return static_cast<uint8_t>(((kSubpixels - below) * upper + below * lower + kHalf) / (2 * kHalf));
  };
  if (x >= 0 && y >= 0 && x < image.width - 1 && y < image.height - 1) {
    const uint8_t* top = image.pixels + static_cast<size_t>(y) * image.stride + x;
    const uint8_t* bottom = top + image.stride;
    return blend(top[0], top[1], bottom[0], bottom[1]);
  }
  const auto pixel = [&](int u, int v) -> int {
    const bool is_inside = u >= 0 && v >= 0 && u < image.width && v < image.height;
    return is_inside ? image.pixels[static_cast<size_t>(v) * image.stride + static_cast<size_t>(u)] : 0;
  };
  return blend(pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1));
}

void align(const EarlierImage& image, const double* back, const AlignedRow& row) {
  const int pixels = row.end - row.begin;
  const int32_t* x = row.places;
  const int32_t* y = row.places + pixels;
  placesOfRow(back, 1, row);
  for (int i = 0; i < pixels; ++i) {
    const bool is_inside = (x[i] >= 0) & (y[i] >= 0) & (x[i] < image.width) & (y[i] < image.height);
    row.unknown[row.begin + i] = is_inside ? 0 : 255;
  }
  placesOfRow(back, kSubpixels, row);
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
