#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/imaging/patch_search_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "redbee/imaging/inverse_search_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSide = kSearchPatch_px;
constexpr int kStripes = 8;  // a fixed number, each with its own neighbours
constexpr float kWorst = 1e10F;
constexpr float kSingular = 1e-3F;

using Four = hn::FixedTag<float, 4>;
using FourOf = hn::Vec<Four>;

// A row of a patch: one vector, or two where vectors are shorter.
#if HWY_MAX_BYTES >= 32
using Lanes = hn::FixedTag<float, 8>;
struct Row {
  hn::Vec<Lanes> all;
};
template <typename Work, typename... Rows>
HWY_INLINE Row each(const Work& work, const Rows&... rows) {
  return {work(rows.all...)};
}
template <typename Make>
HWY_INLINE Row make(const Make& at) {
  return {at(0)};
}
/// Pixel 0 plus pixel 4, 1 plus 5, and so on.
HWY_INLINE FourOf folded(const Row& row) {
  return hn::Add(hn::LowerHalf(Four(), row.all), hn::UpperHalf(Four(), row.all));
}
#else
using Lanes = Four;
struct Row {
  FourOf left, right;
};
template <typename Work, typename... Rows>
HWY_INLINE Row each(const Work& work, const Rows&... rows) {
  return {work(rows.left...), work(rows.right...)};
}
template <typename Make>
HWY_INLINE Row make(const Make& at) {
  return {at(0), at(4)};
}
HWY_INLINE FourOf folded(const Row& row) { return hn::Add(row.left, row.right); }
#endif

HWY_INLINE Row operator+(const Row& a, const Row& b) {
  return each([](auto x, auto y) HWY_ATTR { return hn::Add(x, y); }, a, b);
}
HWY_INLINE Row operator-(const Row& a, const Row& b) {
  return each([](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); }, a, b);
}
HWY_INLINE Row operator*(const Row& a, const Row& b) {
  return each([](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); }, a, b);
}
HWY_INLINE Row spread(float value) {
  return make([&](int) HWY_ATTR { return hn::Set(Lanes(), value); });
}
/// Eight integers of any type.
template <typename T>
HWY_INLINE Row load(const T* from) {
  const hn::RebindToSigned<Lanes> integers;
  const hn::Rebind<T, Lanes> narrow;
  return make([&](int at) HWY_ATTR {
    return hn::ConvertTo(Lanes(), hn::PromoteTo(integers, hn::LoadU(narrow, from + at)));
  });
}
HWY_INLINE float sum(FourOf v) {
  HWY_ALIGN float lane[4];
  hn::Store(v, Four(), lane);
  return (lane[0] + lane[2]) + (lane[1] + lane[3]);
}

/// Bilinear weights of the four neighbours.
struct Weights {
  float top_left, top_right, bottom_left, bottom_right;
};

/// Where a patch lies in the searched image.
struct Place {
  const uint8_t* corner;
  Weights weights;
};

HWY_INLINE Place placeOf(const SearchLevel& level, int x, int y, float u, float v) {
  constexpr float kLeast = kSearchMargin_px - kSide + 1.0F;
  const float row = std::min(std::max(static_cast<float>(y) + v + kSearchMargin_px, kLeast),
                             kSearchMargin_px + static_cast<float>(level.height) - 1);
  const float column = std::min(std::max(static_cast<float>(x) + u + kSearchMargin_px, kLeast),
                                kSearchMargin_px + static_cast<float>(level.width) - 1);
  const int top = static_cast<int>(row), left = static_cast<int>(column);
  const float below = row - static_cast<float>(top), above = static_cast<float>(top) + 1 - row;
  const float after = column - static_cast<float>(left), before = static_cast<float>(left) + 1 - column;
  return {level.to + static_cast<ptrdiff_t>(top) * level.toStride() + left,
          {above * before, above * after, below * before, below * after}};
}

struct Sums {
  float difference, squared, by_x, by_y;
};

/// Differences of the patch at `from` (an offset) to that at `place`; with their products with the gradient
/// if `with_gradient`.
template <bool with_gradient>
HWY_INLINE Sums compare(const SearchLevel& level, size_t from, const Place& place) {
  const Row top_left = spread(place.weights.top_left), top_right = spread(place.weights.top_right);
  const Row bottom_left = spread(place.weights.bottom_left),
            bottom_right = spread(place.weights.bottom_right);
  const uint8_t* to = place.corner;
  Row left = load(to), right = load(to + 1);
  FourOf difference = hn::Zero(Four()), squared = difference, by_x = difference, by_y = difference;
  for (int i = 0; i < kSide; ++i, from += static_cast<size_t>(level.width)) {
    to += level.toStride();
    const Row next_left = load(to), next_right = load(to + 1);
    const Row d = top_left * left + top_right * right + bottom_left * next_left + bottom_right * next_right -
                  load(level.from + from);
    difference = hn::Add(difference, folded(d));
    squared = hn::Add(squared, folded(d * d));
    if constexpr (with_gradient) {
      by_x = hn::Add(by_x, folded(d * load(level.from_x + from)));
      by_y = hn::Add(by_y, folded(d * load(level.from_y + from)));
    }
    left = next_left;
    right = next_right;
  }
  return {sum(difference), sum(squared), with_gradient ? sum(by_x) : 0, with_gradient ? sum(by_y) : 0};
}

/// Of squared differences, less their mean: brightness may change.
HWY_INLINE float cost(const Sums& sums) {
  constexpr float kPixels = kSide * kSide;
  return sums.squared - sums.difference * sums.difference / kPixels;
}

/// Gauss-Newton from (u, v), which stays if the patch runs away.
HWY_INLINE void descend(const SearchLevel& level, const PatchGradients& g, int x, int y, float& u, float& v) {
  constexpr float kPixels = kSide * kSide;
  float determinant = g.xx * g.yy - g.xy * g.xy;
  if (std::abs(determinant) < kSingular) determinant = kSingular;
  const float xx = g.yy / determinant, xy = -g.xy / determinant, yy = g.xx / determinant;
  float at_u = u, at_v = v, before = kWorst;
  for (int i = 0; i < level.iterations; ++i) {
    const Sums sums = compare<true>(level, level.at(x, y), placeOf(level, x, y, at_u, at_v));
    const float by_x = sums.by_x - sums.difference * g.x / kPixels;
    const float by_y = sums.by_y - sums.difference * g.y / kPixels;
    at_u -= xx * by_x + xy * by_y;
    at_v -= xy * by_x + yy * by_y;
    const float now = cost(sums);
    if (now >= before) break;
    before = now;
  }
  const double away_u = at_u - u, away_v = at_v - v;
  if (std::sqrt(away_u * away_u + away_v * away_v) > kSide) return;
  u = at_u;
  v = at_v;
}

/// Patches of a stripe forth (step 1) or back (-1); each tries the flow of the neighbours that come before
/// it.
void sweep(const SearchLevel& level, const PatchGradients* gradients, float* u, float* v, int begin, int end,
           int step) {
  const int first_row = step > 0 ? begin : end - 1, last_row = step > 0 ? end : begin - 1;
  const int first = step > 0 ? 0 : level.columns - 1, last = step > 0 ? level.columns : -1;
  for (int row = first_row; row != last_row; row += step) {
    for (int column = first; column != last; column += step) {
      const size_t patch = level.patch(column, row);
      const int x = column * level.stride_px, y = row * level.stride_px;
      const auto costOf = [&](size_t other) HWY_ATTR {
        return cost(compare<false>(level, level.at(x, y), placeOf(level, x, y, u[other], v[other])));
      };
      float least = costOf(patch);
      const auto tryFlowOf = [&](size_t other) HWY_ATTR {
        const float its = costOf(other);
        if (!(its < least)) return;
        least = its;
        u[patch] = u[other];
        v[patch] = v[other];
      };
      if (column != first) tryFlowOf(level.patch(column - step, row));
      if (row != first_row) tryFlowOf(level.patch(column, row - step));
      descend(level, gradients[patch], x, y, u[patch], v[patch]);
    }
  }
}

void search(const SearchLevel& level, const PatchGradients* gradients, float* u, float* v) {
  const int high = (level.rows + kStripes - 1) / kStripes;
  for (int stripe = 0; stripe < kStripes; ++stripe) {
    const int begin = std::min(stripe * high, level.rows), end = std::min(begin + high, level.rows);
    for (const int step : {1, -1}) sweep(level, gradients, u, v, begin, end, step);
  }
}

void sumPatchRow(const SearchLevel& level, int y, PatchGradients* sums) {
  const hn::FixedTag<int16_t, 8> narrow;
  const hn::FixedTag<int32_t, 4> wide;
  const auto one = hn::Set(narrow, int16_t{1});
  const auto total = [&](auto a, auto b) HWY_ATTR {
    auto rest = hn::Zero(wide);
    const auto products = hn::ReorderWidenMulAccumulate(wide, a, b, hn::Zero(wide), rest);
    return static_cast<float>(hn::GetLane(hn::SumOfLanes(wide, hn::Add(products, rest))));
  };
  for (int column = 0; column < level.columns; ++column) {
    const size_t at = level.at(column * level.stride_px, y);
    const auto gx = hn::LoadU(narrow, level.from_x + at), gy = hn::LoadU(narrow, level.from_y + at);
    sums[column] = {total(gx, gx), total(gx, gy), total(gy, gy), total(gx, one), total(gy, one)};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(search);
HWY_EXPORT(sumPatchRow);

void searchPatches(const SearchLevel& level, const PatchGradients* gradients, float* u, float* v) {
  HWY_DYNAMIC_DISPATCH(search)(level, gradients, u, v);
}

void sumGradients(const SearchLevel& level, int y, PatchGradients* sums) {
  HWY_DYNAMIC_DISPATCH(sumPatchRow)(level, y, sums);
}

}  // namespace redbee
#endif
