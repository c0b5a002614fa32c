#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/parallax/flow_covariance_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/detection/parallax/flow_covariance_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void covariances(const float* tensors, size_t count, float variance, float min_gradient2, float no_gradient2,
                 float* to) {
  forLanes<float>(count, [&](auto d, size_t i) HWY_ATTR {
    const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
    hn::Vec<decltype(d)> xx, xy, yy;
    hn::LoadInterleaved3(d, tensors + 3 * i, xx, xy, yy);
    const auto mean = hn::Mul(constant(0.5F), hn::Add(xx, yy));
    const auto half = hn::Mul(constant(0.5F), hn::Sub(xx, yy));
    const auto radius = hn::Sqrt(hn::Add(hn::Mul(half, half), hn::Mul(xy, xy)));
    const auto least = constant(no_gradient2);
    const auto largest = hn::Add(hn::Add(mean, radius), least);
    const auto smallest = hn::Add(hn::Max(hn::Sub(mean, radius), hn::Zero(d)), least);
    const auto scaled = hn::Div(constant(variance * min_gradient2), hn::Mul(largest, smallest));
    const auto noise = constant(variance);
    hn::StoreInterleaved3(hn::Add(noise, hn::Mul(scaled, hn::Add(yy, least))), hn::Mul(hn::Neg(scaled), xy),
                          hn::Add(noise, hn::Mul(scaled, hn::Add(xx, least))), d, to + 3 * i);
  });
}

void interpolate(const float* map, const BetweenColumns& columns, float* rows) {
  forLanes<float>(columns.width, [&](auto d, size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(d)> integers;
    const auto left = hn::LoadU(integers, columns.left + i), right = hn::LoadU(integers, columns.right + i);
    const auto beyond = hn::LoadU(d, columns.right_weight + i), before = hn::Sub(hn::Set(d, 1.0F), beyond);
    for (size_t entry = 0; entry < 3; ++entry) {
      const auto value = hn::Add(hn::Mul(hn::GatherIndex(d, map + entry, left), before),
                                 hn::Mul(hn::GatherIndex(d, map + entry, right), beyond));
      hn::StoreU(value, d, rows + entry * columns.width + i);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(covariances);
HWY_EXPORT(interpolate);

void covariancesOfTensors(const float* tensors, size_t count, float variance, float min_gradient2,
                          float no_gradient2, float* covariances) {
  HWY_DYNAMIC_DISPATCH(covariances)(tensors, count, variance, min_gradient2, no_gradient2, covariances);
}
void interpolateTensors(const float* map, const BetweenColumns& columns, float* rows) {
  HWY_DYNAMIC_DISPATCH(interpolate)(map, columns, rows);
}

}  // namespace redbee
#endif
