#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/propagation_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/parallax/evidence_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSubpixels = 32;  // places are rounded to these, as cv::remap() does
constexpr float kSmall = 1e-3F;
// Evidence is not reduced while the residual is at least half of the propagated one (squared).
constexpr float kKeptBelow = 4;

/// Where pixels of the row were in the previous frame [1/32 px]: x of all of them, then y.
template <typename D>
HWY_INLINE void places(D d, const Propagation& by, const PropagationRow& row, size_t i) {
  const hn::RebindToSigned<D> integers;
  const auto step = hn::Set(d, by.step);
  hn::Vec<D> u, v;
  hn::LoadInterleaved2(d, row.flow + 2 * i, u, v);
  u = hn::Add(hn::Add(hn::Set(d, static_cast<float>(i)), hn::Iota(d, 0.0F)), hn::Mul(u, step));
  v = hn::Add(hn::Set(d, static_cast<float>(row.y)), hn::Mul(v, step));
  const auto mapped = [&](const float* H) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(hn::Set(d, H[0]), u), hn::Mul(hn::Set(d, H[1]), v)), hn::Set(d, H[2]));
  };
  const auto scale = hn::Div(hn::Set(d, 1.0F), mapped(by.back + 6));
  const auto store = [&](const float* H, int size, int32_t* to) HWY_ATTR {
    // Beyond the border by more than a pixel it is all the same; what is not a number goes there, too.
    const auto at = hn::Mul(mapped(H), scale);
    const auto is_near =
        hn::And(hn::Gt(at, hn::Set(d, -2.0F)), hn::Lt(at, hn::Set(d, static_cast<float>(size) + 1)));
    const auto near = hn::IfThenElse(is_near, at, hn::Set(d, -2.0F));
    hn::StoreU(hn::NearestInt(hn::Mul(near, hn::Set(d, static_cast<float>(kSubpixels)))), integers, to);
  };
  store(by.back, static_cast<int>(row.width), row.places + i);
  store(by.back + 3, row.previous_rows, row.places + row.width + i);
}

using Four = hn::FixedTag<float, 4>;

/// Bilinear; 0 outside of the previous frame.
HWY_INLINE hn::Vec<Four> fetch(const PropagationRow& row, int32_t x32, int32_t y32) {
  const Four d;
  const int columns = static_cast<int>(row.width), rows = row.previous_rows;
  const int x = x32 >> 5, y = y32 >> 5;
  const float right = static_cast<float>(x32 & (kSubpixels - 1)) * (1.0F / kSubpixels), left = 1 - right;
  const float lower = static_cast<float>(y32 & (kSubpixels - 1)) * (1.0F / kSubpixels), upper = 1 - lower;
  const float* at = row.previous + 4 * (static_cast<ptrdiff_t>(y) * columns + x);
  const float* below = at + 4 * columns;
  const auto term = [&](bool is_inside, const float* from, float weight) HWY_ATTR {
    return hn::Mul(is_inside ? hn::LoadU(d, from) : hn::Zero(d), hn::Set(d, weight));
  };
  const bool has_left = x >= 0 && x < columns, has_right = x >= -1 && x < columns - 1;
  const bool has_upper = y >= 0 && y < rows, has_lower = y >= -1 && y < rows - 1;
  auto sum = hn::Add(term(has_left && has_upper, at, upper * left),
                     term(has_right && has_upper, at + 4, upper * right));
  sum = hn::Add(sum, term(has_left && has_lower, below, lower * left));
  return hn::Add(sum, term(has_right && has_lower, below + 4, lower * right));
}

HWY_INLINE void fetchRow(const PropagationRow& row) {
  if (row.previous == nullptr) {
    std::fill_n(row.moving, 4 * row.width, 0.0F);
    return;
  }
  const int32_t* x = row.places;
  const int32_t* y = row.places + row.width;
  for (size_t i = 0; i < row.width; ++i) hn::StoreU(fetch(row, x[i], y[i]), Four(), row.moving + 4 * i);
}

/// Mean of one component over 3x3 pixels around pixel i; mirrored at the border, like the rows.
HWY_INLINE double meanAround(const PropagationRow& row, size_t i, size_t component) {
  const size_t last = row.width - 1;
  const size_t before = row.width == 1 ? 0
                        : i == 0       ? 1
                                       : i - 1,
               after = row.width == 1 ? 0
                       : i == last    ? last - 1
                                      : i + 1;
  double sum = 0;
  for (const float* of : row.residual) {
    sum += static_cast<double>(of[2 * before + component]) + static_cast<double>(of[2 * i + component]) +
           static_cast<double>(of[2 * after + component]);
  }
  return sum * (1.0 / 9);
}

/// Squared length of the mean residual around each pixel, as cv::blur() averages: in double precision.
HWY_INLINE void squaredMeans(const PropagationRow& row, float* to) {
  const auto squared = [&](size_t i, auto mean) {
    const float x = static_cast<float>(mean(row, i, 0)), y = static_cast<float>(mean(row, i, 1));
    to[i] = x * x + y * y;
  };
  squared(0, meanAround);
  for (size_t i = 1; i + 1 < row.width; ++i) {
    squared(i, [](const PropagationRow& of, size_t at, size_t component) {
      double sum = 0;
      for (const float* r : of.residual) {
        const float* p = r + 2 * at + component;
        sum += static_cast<double>(p[-2]) + static_cast<double>(p[0]) + static_cast<double>(p[2]);
      }
      return sum * (1.0 / 9);
    });
  }
  if (row.width > 1) squared(row.width - 1, meanAround);
}

template <typename D>
HWY_INLINE void accumulate(D d, const Propagation& by, const PropagationRow& row, const float* around2,
                           size_t i) {
  const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  const auto squares = [&](hn::Vec<D> a, hn::Vec<D> b)
                           HWY_ATTR { return hn::Add(hn::Mul(a, a), hn::Mul(b, b)); };
  hn::Vec<D> evidence, u, v, length, off_u, off_v;
  hn::LoadInterleaved4(d, row.moving + 4 * i, evidence, u, v, length);
  hn::LoadInterleaved2(d, row.residual[1] + 2 * i, off_u, off_v);
  const auto half2 = constant(by.half2);
  const auto around = hn::Add(hn::Mul(constant(kKeptBelow), hn::LoadU(d, around2 + i)), half2);
  // Background that an object has just uncovered is static where the object moved: it inherits no evidence.
  const auto kept = hn::Min(constant(1), hn::Div(around, hn::Add(squares(u, v), half2)));
  const auto old = hn::Mul(kept, constant(1 - by.rate)), rate = constant(by.rate);
  const auto off2 = squares(off_u, off_v);
  const auto is_known =
      hn::Eq(hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<uint8_t, D>(), row.unknown + i)),
             hn::Zero(hn::RebindToSigned<D>()));
  const auto mixed = [&](hn::Vec<D> then, hn::Vec<D> now) HWY_ATTR {
    return hn::IfThenElseZero(hn::RebindMask(d, is_known), hn::Add(hn::Mul(old, then), hn::Mul(rate, now)));
  };
  evidence = mixed(evidence, hn::Div(off2, hn::Add(off2, half2)));
  u = mixed(u, off_u);
  v = mixed(v, off_v);
  length = mixed(length, hn::Sqrt(off2));
  hn::StoreInterleaved4(evidence, u, v, length, d, row.moving + 4 * i);
  const auto net2 = squares(u, v);
  const auto coherence = hn::Div(net2, hn::Add(hn::Mul(length, length), constant(kSmall)));
  const auto moves =
      hn::Div(hn::Mul(hn::Mul(evidence, coherence), net2), hn::Add(net2, constant(by.motion_half2)));
  hn::StoreU(hn::Sqrt(moves), d, row.motion + i);
}

template <typename Work>
HWY_INLINE void forLanes(size_t width, const Work& work) {
  const hn::ScalableTag<float> d;
  size_t i = 0;
  for (; i + hn::Lanes(d) <= width; i += hn::Lanes(d)) work(d, i);
  for (; i < width; ++i) work(hn::CappedTag<float, 1>(), i);
}

void propagate(const Propagation& by, const PropagationRow& row) {
  forLanes(row.width, [&](auto d, size_t i) HWY_ATTR { places(d, by, row, i); });
  fetchRow(row);
  squaredMeans(row, row.motion);
  forLanes(row.width, [&](auto d, size_t i) HWY_ATTR { accumulate(d, by, row, row.motion, i); });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(propagate);

void propagateRow(const Propagation& by, const PropagationRow& row) {
  HWY_DYNAMIC_DISPATCH(propagate)(by, row);
}

}  // namespace redbee
#endif
