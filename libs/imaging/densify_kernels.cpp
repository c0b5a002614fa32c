#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/imaging/densify_kernels.cpp"
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
constexpr int kRowsKept = 16;     // of weights: more than a patch and the rest of the last stride
constexpr float kInside = 1e-3F;  // px, from the last pixel: there is a neighbour to interpolate with
using Lanes = hn::CappedTag<float, 8>;

/// Sums over patches for one row of pixels.
struct Accumulated {
  float* flow;  ///< x and y alternating
  float* weights;
};

/// One coordinate in the searched image: whole part, and distances to both neighbours.
struct Coordinate {
  Coordinate(int pixel, float flow, int size) {
    const float at =
        std::min(std::max(static_cast<float>(pixel) + flow, 0.0F), static_cast<float>(size) - 1 - kInside);
    whole = static_cast<int>(at);
    from = at - static_cast<float>(whole);
    to = static_cast<float>(whole + 1) - at;
  }
  int whole;
  float from, to;
};

HWY_INLINE const uint8_t* pixelAt(const SearchLevel& level, int x, int y) {
  return level.to + static_cast<ptrdiff_t>(y + kSearchMargin_px) * level.toStride() + kSearchMargin_px + x;
}

void addPixel(const SearchLevel& level, int x, int y, const Coordinate& row, float u, float v,
              const Accumulated& to) {
  const Coordinate column(x, u, level.width);
  const uint8_t* above = pixelAt(level, column.whole, row.whole);
  const uint8_t* below = above + level.toStride();
  const float difference = column.from * row.from * below[1] + column.to * row.from * below[0] +
                           column.from * row.to * above[1] + column.to * row.to * above[0] -
                           level.from[level.at(x, y)];
  const float weight = 1 / std::max(1.0F, std::abs(difference));
  to.flow[2 * x] += weight * u;
  to.flow[2 * x + 1] += weight * v;
  to.weights[x] += weight;
}

/// The columns of a patch, whose neighbours in the searched image are neighbours, too.
struct Columns {
  const uint8_t* base;
  HWY_ALIGN float from[kSide];
  HWY_ALIGN float to[kSide];
};

/// False where the patch reaches the image's border, or rounding separates neighbours.
HWY_INLINE bool areNeighbours(const SearchLevel& level, int x, float u, Columns& columns, int& first) {
  if (static_cast<float>(x) + u < 0) return false;
  first = static_cast<int>(static_cast<float>(x) + u);
  if (first + kSide >= level.width - 1) return false;
  for (int i = 0; i < kSide; ++i) {
    const float at = static_cast<float>(x + i) + u;
    const float whole = static_cast<float>(first + i);
    columns.from[i] = at - whole;
    columns.to[i] = whole + 1 - at;
    if (!(at >= whole && at < whole + 1)) return false;
  }
  return true;
}

HWY_INLINE hn::Vec<Lanes> bytes(const uint8_t* from) {
  const hn::RebindToSigned<Lanes> integers;
  const hn::Rebind<uint8_t, Lanes> narrow;
  return hn::ConvertTo(Lanes(), hn::PromoteTo(integers, hn::LoadU(narrow, from)));
}

HWY_INLINE void addRow(const SearchLevel& level, const Columns& columns, int first, int x, int y,
                       const Coordinate& row, float u, float v, const Accumulated& to) {
  const Lanes d;
  const uint8_t* above = pixelAt(level, first, row.whole);
  const uint8_t* below = above + level.toStride();
  const uint8_t* from = level.from + level.at(x, y);
  for (int i = 0; i < kSide; i += static_cast<int>(hn::MaxLanes(d))) {
    const auto right = hn::Load(d, columns.from + i), left = hn::Load(d, columns.to + i);
    const auto lower = hn::Set(d, row.from), upper = hn::Set(d, row.to);
    auto sample = hn::Mul(hn::Mul(right, lower), bytes(below + i + 1));
    sample = hn::Add(sample, hn::Mul(hn::Mul(left, lower), bytes(below + i)));
    sample = hn::Add(sample, hn::Mul(hn::Mul(right, upper), bytes(above + i + 1)));
    sample = hn::Add(sample, hn::Mul(hn::Mul(left, upper), bytes(above + i)));
    const auto difference = hn::Abs(hn::Sub(sample, bytes(from + i)));
    const auto one = hn::Set(d, 1.0F);
    const auto weight = hn::Div(one, hn::Max(one, difference));
    float* weights = to.weights + x + i;
    hn::StoreU(hn::Add(hn::LoadU(d, weights), weight), d, weights);
    float* flow = to.flow + 2 * (x + i);
    hn::Vec<Lanes> sum_u, sum_v;
    hn::LoadInterleaved2(d, flow, sum_u, sum_v);
    hn::StoreInterleaved2(hn::Add(sum_u, hn::Mul(weight, hn::Set(d, u))),
                          hn::Add(sum_v, hn::Mul(weight, hn::Set(d, v))), d, flow);
  }
}

HWY_INLINE void finish(int width, const Accumulated& row) {
  for (int x = 0; x < width; ++x) {
    row.flow[2 * x] /= row.weights[x];
    row.flow[2 * x + 1] /= row.weights[x];
  }
}

void dense(const SearchLevel& level, const float* u, const float* v, float* weights, float* flow) {
  const auto width = static_cast<size_t>(level.width);
  const auto rowOf = [&](int y) {
    return Accumulated{flow + 2 * level.at(0, y), weights + static_cast<size_t>(y % kRowsKept) * width};
  };
  int begun = 0;
  for (int row = 0; row < level.rows; ++row) {
    // The last patches of a row or column stand for what is left of the image.
    const bool is_last_row = row + 1 == level.rows;
    const int y = row * level.stride_px, end_y = is_last_row ? level.height : y + kSide;
    for (; begun < end_y; ++begun) {
      std::fill_n(rowOf(begun).flow, 2 * width, 0.0F);
      std::fill_n(rowOf(begun).weights, width, 0.0F);
    }
    for (int column = 0; column < level.columns; ++column) {
      const size_t patch = level.patch(column, row);
      const int x = column * level.stride_px, end_x = column + 1 == level.columns ? level.width : x + kSide;
      Columns columns;
      int first = 0;
      const bool together = areNeighbours(level, x, u[patch], columns, first);
      for (int i = y; i < end_y; ++i) {
        const Coordinate at(i, v[patch], level.height);
        const Accumulated to = rowOf(i);
        if (together) addRow(level, columns, first, x, i, at, u[patch], v[patch], to);
        for (int j = together ? x + kSide : x; j < end_x; ++j)
          addPixel(level, j, i, at, u[patch], v[patch], to);
      }
    }
    for (int i = y; i < (is_last_row ? level.height : y + level.stride_px); ++i)
      finish(level.width, rowOf(i));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(dense);

void densify(const SearchLevel& level, const float* u, const float* v, float* weights, float* flow) {
  HWY_DYNAMIC_DISPATCH(dense)(level, u, v, weights, flow);
}

}  // namespace redbee
#endif
