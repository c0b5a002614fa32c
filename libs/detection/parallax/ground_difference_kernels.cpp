#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/ground_difference_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/parallax/ground_difference_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// As many bytes as `d` has lanes, as values of 32 bits.
template <typename D>
HWY_INLINE hn::Vec<D> load(D d, const uint8_t* from) {
  const hn::Rebind<uint8_t, D> bytes;
  return hn::PromoteTo(d, hn::LoadU(bytes, from));
}

HWY_INLINE float varianceAt(const NeighbourRows& rows, const SlopeVariance& by, int x) {
  const int last = rows.width - 1, next = std::min(1, last);
  const int left = x > 0 ? x - 1 : next, right = x < last ? x + 1 : last - next;
  const auto across = [&](const uint8_t* row) { return row[right] - row[left]; };
  const auto along = [&](const uint8_t* row) { return row[left] + 2 * row[x] + row[right]; };
  const int dx = across(rows.above) + 2 * across(rows.row) + across(rows.below);
  const int dy = along(rows.below) - along(rows.above);
  return by.noise2 + by.per_square * static_cast<float>(dx * dx + dy * dy);
}

void variances(const NeighbourRows& rows, const SlopeVariance& by, int begin, int end, float* variance) {
  const int first = std::max(begin, 1), last = std::min(end, rows.width - 1);
  for (int x = begin; x < std::min(first, end); ++x) variance[x] = varianceAt(rows, by, x);
  if (first < last) {
    forLanes<float>(static_cast<size_t>(last - first), [&](auto d, size_t i) HWY_ATTR {
      const hn::RebindToSigned<decltype(d)> integers;
      const size_t x = static_cast<size_t>(first) + i;
      const auto across = [&](const uint8_t* row) HWY_ATTR {
        return hn::Sub(load(integers, row + x + 1), load(integers, row + x - 1));
      };
      const auto along = [&](const uint8_t* row) HWY_ATTR {
        const auto middle = load(integers, row + x);
        return hn::Add(hn::Add(load(integers, row + x - 1), load(integers, row + x + 1)),
                       hn::Add(middle, middle));
      };
      const auto own = across(rows.row);
      const auto dx = hn::Add(hn::Add(across(rows.above), across(rows.below)), hn::Add(own, own));
      const auto dy = hn::Sub(along(rows.below), along(rows.above));
      const auto squares = hn::ConvertTo(d, hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
      hn::StoreU(hn::Add(hn::Set(d, by.noise2), hn::Mul(hn::Set(d, by.per_square), squares)), d,
                 variance + x);
    });
  }
  for (int x = std::max(last, begin); x < end; ++x) variance[x] = varianceAt(rows, by, x);
}

void lesser(const ComparedRow& row, int begin, int end, uint8_t* least) {
  forLanes<float>(static_cast<size_t>(end - begin), [&](auto d, size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(d)> integers;
    const hn::Rebind<uint8_t, decltype(d)> bytes;
    const size_t x = static_cast<size_t>(begin) + i;
    const auto difference =
        hn::ConvertTo(d, hn::Sub(load(integers, row.now + x), load(integers, row.then + x)));
    const auto square = hn::Mul(difference, difference);
    const auto fraction = hn::ConvertTo(integers, hn::Div(hn::Mul(hn::Set(d, 255.0F), square),
                                                          hn::Add(square, hn::LoadU(d, row.variance + x))));
    const auto is_known = hn::Eq(load(integers, row.unknown + x), hn::Zero(integers));
    const auto lesser = hn::Min(load(integers, least + x), hn::IfThenElseZero(is_known, fraction));
    hn::StoreU(hn::DemoteTo(bytes, lesser), bytes, least + x);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(variances);
HWY_EXPORT(lesser);

void varianceOfRow(const NeighbourRows& rows, const SlopeVariance& by, int begin, int end, float* variance) {
  HWY_DYNAMIC_DISPATCH(variances)(rows, by, begin, end, variance);
}
void keepLesser(const ComparedRow& row, int begin, int end, uint8_t* least) {
  HWY_DYNAMIC_DISPATCH(lesser)(row, begin, end, least);
}

}  // namespace redbee
#endif
