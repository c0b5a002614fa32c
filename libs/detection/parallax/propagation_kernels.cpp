#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/propagation_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/parallax/evidence_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

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
  if (static_cast<unsigned>(x) < static_cast<unsigned>(columns - 1) &&
      static_cast<unsigned>(y) < static_cast<unsigned>(rows - 1)) {
    const auto of = [&](const float* from, float weight)
                        HWY_ATTR { return hn::Mul(hn::LoadU(d, from), hn::Set(d, weight)); };
    const auto above = hn::Add(of(at, upper * left), of(at + 4, upper * right));
    return hn::Add(hn::Add(above, of(below, lower * left)), of(below + 4, lower * right));
  }
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

/// Mean residual over 3x3 pixels, as cv::blur() averages: in double precision, mirrored at the border like
/// the rows. `sums`: room for the row and two pixels.
HWY_INLINE void meanResiduals(const PropagationRow& row, double* sums, float* mean) {
  const size_t values = 2 * row.width;
  double* const inner = sums + 2;
  const hn::ScalableTag<double> d;
  const auto forValues = [&](const auto& work) HWY_ATTR {
    size_t i = 0;
    for (; i + hn::Lanes(d) <= values; i += hn::Lanes(d)) work(d, i);
    for (; i < values; ++i) work(hn::CappedTag<double, 1>(), i);
  };
  forValues([&](auto of, size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(of)> narrow;
    const auto value = [&](int k)
                           HWY_ATTR { return hn::PromoteTo(of, hn::LoadU(narrow, row.residual[k] + i)); };
    hn::StoreU(hn::Add(hn::Add(value(0), value(1)), value(2)), of, inner + i);
  });
  const size_t neighbour = row.width > 1 ? 2 : 0;
  for (size_t k = 0; k < 2; ++k) {
    sums[k] = inner[neighbour + k];
    inner[values + k] = inner[values - 2 - neighbour + k];
  }
  forValues([&](auto of, size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(of)> narrow;
    const auto sum =
        hn::Add(hn::Add(hn::LoadU(of, sums + i), hn::LoadU(of, sums + i + 2)), hn::LoadU(of, sums + i + 4));
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(sum, hn::Set(of, 1.0 / 9))), narrow, mean + i);
  });
}

template <typename D>
HWY_INLINE void accumulate(D d, const Propagation& by, const PropagationRow& row, size_t i) {
  const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  const auto squares = [&](hn::Vec<D> a, hn::Vec<D> b)
                           HWY_ATTR { return hn::Add(hn::Mul(a, a), hn::Mul(b, b)); };
  hn::Vec<D> evidence, u, v, length, off_u, off_v, mean_u, mean_v;
  hn::LoadInterleaved4(d, row.moving + 4 * i, evidence, u, v, length);
  hn::LoadInterleaved2(d, row.residual[1] + 2 * i, off_u, off_v);
  hn::LoadInterleaved2(d, row.mean_residual + 2 * i, mean_u, mean_v);
  const auto half2 = constant(by.half2);
  const auto around = hn::Add(hn::Mul(constant(kKeptBelow), squares(mean_u, mean_v)), half2);
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

void propagate(const Propagation& by, const PropagationRow& row) {
  forLanes<float>(row.width, [&](auto d, size_t i) HWY_ATTR { places(d, by, row, i); });
  fetchRow(row);
  meanResiduals(row, row.sums, row.mean_residual);
  forLanes<float>(row.width, [&](auto d, size_t i) HWY_ATTR { accumulate(d, by, row, i); });
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
