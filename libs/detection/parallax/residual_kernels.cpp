#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/residual_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/evidence_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename D>
struct Vector {
  hn::Vec<D> x, y;
};

template <typename D>
HWY_INLINE hn::Vec<D> dot(D, const Vector<D>& a, const Vector<D>& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y));
}
template <typename D>
HWY_INLINE Vector<D> times(D, const hn::Vec<D>& a, const Vector<D>& b) {
  return {hn::Mul(a, b.x), hn::Mul(a, b.y)};
}

template <typename D>
struct Symmetric {
  hn::Vec<D> xx, xy, yy;
};
template <typename D>
HWY_INLINE Vector<D> times(D, const Symmetric<D>& A, const Vector<D>& v) {
  return {hn::Add(hn::Mul(A.xx, v.x), hn::Mul(A.xy, v.y)), hn::Add(hn::Mul(A.xy, v.x), hn::Mul(A.yy, v.y))};
}

template <typename D>
HWY_INLINE Symmetric<D> interpolated(D d, const ResidualRow& row, size_t x) {
  const auto upper = hn::Set(d, row.upper_weight), lower = hn::Set(d, row.lower_weight);
  const auto entry = [&](int i) HWY_ATTR {
    return hn::Add(hn::Mul(hn::LoadU(d, row.upper[i] + x), upper),
                   hn::Mul(hn::LoadU(d, row.lower[i] + x), lower));
  };
  return {entry(0), entry(1), entry(2)};
}

template <typename D>
HWY_INLINE Vector<D> at(D d, const SmoothFlow& flow, hn::Vec<D> x, float y) {
  const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  const auto u = hn::Div(hn::Sub(x, constant(flow.middle[0])), constant(flow.unit));
  const float v = (y - flow.middle[1]) / flow.unit;
  const auto scale = hn::Add(hn::Mul(constant(flow.perspective[0]), u), constant(flow.perspective[1] * v));
  const auto component = [&](const float* a, hn::Vec<D> outwards) HWY_ATTR {
    const auto affine = hn::Add(hn::Add(hn::Mul(constant(a[0]), u), constant(a[1] * v)), constant(a[2]));
    return hn::Add(affine, hn::Mul(scale, outwards));
  };
  return {component(flow.affine, u), component(flow.affine + 3, constant(v))};
}

template <typename D>
HWY_INLINE hn::Vec<D> largestOf(D d, const Symmetric<D>& C) {
  const auto half = hn::Set(d, 0.5F);
  const auto mean = hn::Mul(half, hn::Add(C.xx, C.yy)), by = hn::Mul(half, hn::Sub(C.xx, C.yy));
  return hn::Add(mean, hn::Sqrt(hn::Add(hn::Mul(by, by), hn::Mul(C.xy, C.xy))));
}

template <typename D>
HWY_INLINE Symmetric<D> inverseRoot(D d, const Symmetric<D>& C) {
  const auto xy2 = hn::Mul(C.xy, C.xy);
  const auto r = hn::Sqrt(hn::Sub(hn::Mul(C.xx, C.yy), xy2));
  const auto xx = hn::Add(C.xx, r), yy = hn::Add(C.yy, r);
  const auto trace = hn::Add(hn::Add(C.xx, C.yy), hn::Mul(hn::Set(d, 2.0F), r));
  const auto factor = hn::Div(hn::Sqrt(trace), hn::Sub(hn::Mul(xx, yy), xy2));
  return {hn::Mul(factor, yy), hn::Neg(hn::Mul(factor, C.xy)), hn::Mul(factor, xx)};
}

/// Adds the variance of the direction, across it and in proportion to the flow along it.
template <typename D>
HWY_INLINE Symmetric<D> withDirection(D d, const Symmetric<D>& C, const Vector<D>& direction,
                                      hn::Vec<D> along, float variance) {
  const auto factor = hn::Mul(hn::Mul(hn::Set(d, variance), along), along);
  const auto x = hn::Neg(direction.y), y = direction.x;
  return {hn::Add(C.xx, hn::Mul(factor, hn::Mul(x, x))), hn::Add(C.xy, hn::Mul(factor, hn::Mul(x, y))),
          hn::Add(C.yy, hn::Mul(factor, hn::Mul(y, y)))};
}

template <typename D>
HWY_INLINE void storeResidual(D d, const Vector<D>& residual, const ResidualRow& row, size_t i) {
  const hn::RebindToSigned<D> integers;
  const auto unknown = hn::PromoteTo(integers, hn::LoadU(hn::Rebind<uint8_t, D>(), row.unknown + i));
  const auto is_known = hn::RebindMask(d, hn::Eq(unknown, hn::Zero(integers)));
  const auto squared = hn::Min(dot(d, residual, residual), hn::Set(d, kMostSquaredResidual));
  hn::StoreU(hn::IfThenElse(is_known, squared, hn::Set(d, kNotCompared)), d, row.squared + i);
  hn::StoreInterleaved2(hn::IfThenElseZero(is_known, residual.x), hn::IfThenElseZero(is_known, residual.y), d,
                        row.normalized_residual + 2 * i);
}

template <typename D>
HWY_INLINE void residuals(D d, const SmoothFlow& error, const float* epipole, float direction_variance,
                          const ResidualRow& row, size_t i) {
  const auto y = static_cast<float>(row.y);
  const auto x = hn::Add(hn::Set(d, static_cast<float>(i)), hn::Iota(d, 0.0F));
  Vector<D> back;
  hn::LoadInterleaved2(d, row.flow + 2 * i, back.x, back.y);
  const Vector<D> off = at(d, error, x, y);
  const Vector<D> flow{hn::Sub(hn::Neg(back.x), off.x), hn::Sub(hn::Neg(back.y), off.y)};
  const auto towards = [&](int k, hn::Vec<D> ground) HWY_ATTR {
    return hn::Sub(hn::Set(d, epipole[k]), hn::Mul(hn::Set(d, epipole[2]), ground));
  };
  const Vector<D> end{towards(0, hn::Add(x, back.x)), towards(1, hn::Add(hn::Set(d, y), back.y))};
  auto length = hn::Sqrt(dot(d, end, end));
  constexpr float kNoDirection = 1e-6F;
  const auto is_ray = hn::Not(hn::Lt(length, hn::Set(d, kNoDirection)));
  Vector<D> direction = times(d, hn::Div(hn::Set(d, 1.0F), length), end);
  direction = {hn::IfThenElseZero(is_ray, direction.x), hn::IfThenElseZero(is_ray, direction.y)};
  length = hn::IfThenElseZero(is_ray, length);
  const Symmetric<D> noise = interpolated(d, row, i);
  const Symmetric<D> root =
      inverseRoot(d, withDirection(d, noise, direction, dot(d, flow, direction), direction_variance));
  const Vector<D> whitened = times(d, root, flow), step = times(d, root, direction);
  const auto along = hn::Div(dot(d, whitened, step), dot(d, step, step));
  const auto nearest = hn::IfThenElseZero(is_ray, hn::Min(hn::Max(along, hn::Zero(d)), length));
  storeResidual(
      d, {hn::Sub(whitened.x, hn::Mul(nearest, step.x)), hn::Sub(whitened.y, hn::Mul(nearest, step.y))}, row,
      i);
  hn::StoreInterleaved2(hn::Mul(nearest, direction.x), hn::Mul(nearest, direction.y), d, row.nearest + 2 * i);
  hn::StoreInterleaved2(hn::Sqrt(dot(d, flow, flow)), largestOf(d, noise), d, row.speed + 2 * i);
}

void residualsOfRow(const SmoothFlow& error, const float* epipole, float direction_variance,
                    const ResidualRow& row) {
  forLanes<float>(row.width, [&](auto d, size_t i)
                                 HWY_ATTR { residuals(d, error, epipole, direction_variance, row, i); });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(residualsOfRow);

void residualRow(const SmoothFlow& error, const float epipole[3], float direction_variance,
                 const ResidualRow& row) {
  HWY_DYNAMIC_DISPATCH(residualsOfRow)(error, epipole, direction_variance, row);
}

}  // namespace redbee
#endif
