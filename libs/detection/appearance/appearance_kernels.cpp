#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/appearance/appearance_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "redbee/detection/appearance/appearance_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kFirstVariance = 400;  // after the first image: the pixel may lie on an edge
constexpr float kMostVariance = 1000;  // a passing object must not raise the background's variance
constexpr int kTrusted = 3;            // images after which moving pixels are learned slowly
constexpr int kOldest = 255;
constexpr float kMovingFraction = 0.05F;  // of the learning rate, where the pixel certainly moves
constexpr float kSurelyMovedAway = 0.5F;  // above this the pixel's model is reset

template <typename D>
struct Pixels {
  hn::Vec<D> blue, green, red, fourth;
};

template <typename D>
HWY_INLINE Pixels<D> load(D d, const float* from) {
  Pixels<D> p;
  hn::LoadInterleaved4(d, from, p.blue, p.green, p.red, p.fourth);
  return p;
}
template <typename D>
HWY_INLINE Pixels<D> difference(D, const Pixels<D>& a, const Pixels<D>& b) {
  return {hn::Sub(a.blue, b.blue), hn::Sub(a.green, b.green), hn::Sub(a.red, b.red), a.fourth};
}
/// Mean square over the colours.
template <typename D>
HWY_INLINE hn::Vec<D> meanSquare(D d, const Pixels<D>& p) {
  const auto sum =
      hn::Add(hn::Add(hn::Mul(p.blue, p.blue), hn::Mul(p.red, p.red)), hn::Mul(p.green, p.green));
  return hn::Mul(sum, hn::Set(d, 1.0F / 3));
}
template <typename D>
HWY_INLINE hn::Vec<D> movedAway(D d, const SurfaceReset& reset, hn::Vec<D> learned, hn::Vec<D> speed,
                                hn::Vec<D> variance) {
  if (!reset.is_used) return hn::Zero(d);
  const auto slower = hn::Max(hn::Zero(d), hn::Sub(learned, speed));
  const auto gone = hn::Mul(slower, slower);
  return hn::Div(gone, hn::Add(gone, hn::Mul(hn::Set(d, reset.sigmas2), variance)));
}
template <typename D>
HWY_INLINE auto integers(D, const uint8_t* from) {
  return hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<uint8_t, D>(), from));
}

/// Pixels i and on, whose neighbours begin at `left` and `right`.
template <typename D>
HWY_INLINE void differ(D d, const DifferenceRow& row, float noise2, float edge2, const SurfaceReset& reset,
                       size_t i, size_t left, size_t right) {
  const Pixels<D> known = load(d, row.model[1] + 4 * i);
  const auto across =
      meanSquare(d, difference(d, load(d, row.model[1] + 4 * right), load(d, row.model[1] + 4 * left)));
  const auto down =
      meanSquare(d, difference(d, load(d, row.model[2] + 4 * i), load(d, row.model[0] + 4 * i)));
  const auto slope = hn::Mul(hn::Set(d, 0.25F), hn::Add(across, down));
  const auto noise = hn::Add(hn::Add(known.fourth, hn::Set(d, noise2)), hn::Mul(hn::Set(d, edge2), slope));
  const auto d2 = meanSquare(d, difference(d, load(d, row.image + 4 * i), known));
  hn::Vec<D> speed, variance;
  hn::LoadInterleaved2(d, row.speed + 2 * i, speed, variance);
  const auto one = hn::Set(d, 1.0F);
  const auto away = movedAway(d, reset, hn::LoadU(d, row.learned_speed + i), speed, variance);
  const auto lit = hn::Mul(hn::Div(d2, hn::Add(d2, noise)), hn::Sub(one, hn::LoadU(d, row.shadow + i)));
  const auto age = integers(d, row.age + i);
  const auto is_known = hn::RebindMask(d, hn::Gt(age, hn::Zero(hn::RebindToSigned<D>())));
  hn::StoreU(hn::IfThenElseZero(is_known, hn::Mul(lit, hn::Sub(one, away))), d, row.difference + i);
}

void differencesOfRow(const DifferenceRow& row, float noise2, float edge2, const SurfaceReset& reset) {
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const size_t last = row.width - 1;
  differ(one, row, noise2, edge2, reset, 0, 0, std::min<size_t>(1, last));
  size_t i = 1;
  for (; i + hn::Lanes(d) <= last; i += hn::Lanes(d)) differ(d, row, noise2, edge2, reset, i, i - 1, i + 1);
  for (; i <= last; ++i) differ(one, row, noise2, edge2, reset, i, i - 1, std::min(i + 1, last));
}

template <typename D>
HWY_INLINE void learn(D d, const LearningRow& row, const RatesByAge& mean_rates,
                      const RatesByAge& variance_rates, const SurfaceReset& reset, size_t i) {
  const hn::RebindToSigned<D> whole;
  const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  hn::Vec<D> speed, speed_variance;
  hn::LoadInterleaved2(d, row.speed + 2 * i, speed, speed_variance);
  const auto learned = hn::LoadU(d, row.learned_speed + i);
  const auto away = movedAway(d, reset, learned, speed, speed_variance);
  const auto is_gone = hn::RebindMask(whole, hn::Gt(away, constant(kSurelyMovedAway)));
  const auto age = hn::IfThenZeroElse(is_gone, integers(d, row.age + i));
  const auto is_new = hn::RebindMask(d, hn::Eq(age, hn::Zero(whole)));
  const auto is_young = hn::RebindMask(d, hn::Lt(age, hn::Set(whole, kTrusted)));
  Pixels<D> known = load(d, row.model + 4 * i);
  const Pixels<D> now = load(d, row.image + 4 * i), off = difference(d, now, known);
  const auto slowly =
      hn::Sub(constant(1), hn::Mul(constant(1 - kMovingFraction), hn::LoadU(d, row.moving + i)));
  const auto rate =
      hn::Mul(hn::GatherIndex(d, mean_rates.data(), age), hn::IfThenElse(is_young, constant(1), slowly));
  const auto change = hn::Sub(hn::Min(meanSquare(d, off), constant(kMostVariance)), known.fourth);
  const auto variance =
      hn::Add(known.fourth, hn::Mul(hn::GatherIndex(d, variance_rates.data(), age), change));
  const auto followed = [&](hn::Vec<D> from, hn::Vec<D> by)
                            HWY_ATTR { return hn::Add(from, hn::Mul(rate, by)); };
  hn::StoreInterleaved4(followed(known.blue, off.blue), followed(known.green, off.green),
                        followed(known.red, off.red),
                        hn::IfThenElse(is_new, constant(kFirstVariance), variance), d, row.model + 4 * i);
  hn::StoreU(hn::IfThenElse(is_new, speed, followed(learned, hn::Sub(speed, learned))), d,
             row.learned_speed + i);
  const auto older = hn::Min(hn::Add(age, hn::Set(whole, 1)), hn::Set(whole, kOldest));
  const hn::Rebind<uint8_t, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, older), narrow, row.age + i);
}

void learnOneRow(const LearningRow& row, const RatesByAge& mean_rates, const RatesByAge& variance_rates,
                 const SurfaceReset& reset) {
  forLanes<float>(row.width,
                  [&](auto d, size_t i) HWY_ATTR { learn(d, row, mean_rates, variance_rates, reset, i); });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(differencesOfRow);
HWY_EXPORT(learnOneRow);

void differenceRow(const DifferenceRow& row, float noise2, float edge2, const SurfaceReset& reset) {
  HWY_DYNAMIC_DISPATCH(differencesOfRow)(row, noise2, edge2, reset);
}
void learnRow(const LearningRow& row, const RatesByAge& mean_rates, const RatesByAge& variance_rates,
              const SurfaceReset& reset) {
  HWY_DYNAMIC_DISPATCH(learnOneRow)(row, mean_rates, variance_rates, reset);
}

}  // namespace redbee
#endif
