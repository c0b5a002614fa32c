#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/detection/appearance/shadow_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/detection/appearance/appearance_kernels.hpp"
#include "redbee/imaging/for_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kValues = 3 * 3 * 3;  // colours and pixels of the window
// Brightness of a shadow relative to the lit surface, in gamma-encoded grey levels: skylight is 0.1 to 0.5 of
// the total light, which gives 0.35 to 0.75.
constexpr float kDarkest = 0.4F;
constexpr float kDarkestRamp = 0.1F;
constexpr float kLightest = 0.95F;
constexpr float kLightestRamp = 0.05F;

HWY_INLINE void sumThree(const float* of, size_t width, float* to) {
  if (width == 1) {
    to[0] = of[0];
    return;
  }
  to[0] = 2 * of[0] + of[1];
  for (size_t x = 1; x + 1 < width; ++x) to[x] = of[x - 1] + of[x] + of[x + 1];
  to[width - 1] = of[width - 2] + 2 * of[width - 1];
}

void shadowSums(const float* image, const float* background, size_t width, float* products,
                const ShadowSums& sums) {
  float* const pp = products;
  float* const pb = products + width;
  float* const bb = products + 2 * width;
  forLanes<float>(width, [&](auto d, size_t i) HWY_ATTR {
    hn::Vec<decltype(d)> p0, p1, p2, b0, b1, b2, rest;
    hn::LoadInterleaved4(d, image + 4 * i, p0, p1, p2, rest);
    hn::LoadInterleaved4(d, background + 4 * i, b0, b1, b2, rest);
    hn::StoreU(hn::Add(hn::Mul(p0, p0), hn::Add(hn::Mul(p1, p1), hn::Mul(p2, p2))), d, pp + i);
    hn::StoreU(hn::Add(hn::Mul(p0, b0), hn::Add(hn::Mul(p1, b1), hn::Mul(p2, b2))), d, pb + i);
    hn::StoreU(hn::Add(hn::Mul(b0, b0), hn::Add(hn::Mul(b1, b1), hn::Mul(b2, b2))), d, bb + i);
  });
  sumThree(pp, width, sums.pp);
  sumThree(pb, width, sums.pb);
  sumThree(bb, width, sums.bb);
}

void shadowScores(const ShadowSums* rows, size_t width, float noise_variance, float* shadow) {
  forLanes<float>(width, [&](auto d, size_t i) HWY_ATTR {
    const auto constant = [&](float value) HWY_ATTR { return hn::Set(d, value); };
    const auto total = [&](float* ShadowSums::*of) HWY_ATTR {
      return hn::Add(hn::Add(hn::LoadU(d, rows[0].*of + i), hn::LoadU(d, rows[1].*of + i)),
                     hn::LoadU(d, rows[2].*of + i));
    };
    const auto bounded = [&](auto value)
                             HWY_ATTR { return hn::Min(hn::Max(value, hn::Zero(d)), hn::Set(d, 1.0F)); };
    const auto pp = total(&ShadowSums::pp), pb = total(&ShadowSums::pb), bb = total(&ShadowSums::bb);
    const auto scale = hn::Div(pb, hn::Max(bb, constant(1)));
    const auto dark = bounded(hn::Div(hn::Sub(scale, constant(kDarkest)), constant(kDarkestRamp)));
    const auto light = bounded(hn::Div(hn::Sub(constant(kLightest), scale), constant(kLightestRamp)));
    const auto left = hn::Div(hn::Max(hn::Zero(d), hn::Sub(pp, hn::Mul(scale, pb))), constant(kValues));
    const auto misfit = hn::Div(left, constant(noise_variance));
    hn::StoreU(hn::Div(hn::Mul(dark, light), hn::Add(constant(1), hn::Mul(misfit, misfit))), d, shadow + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(shadowSums);
HWY_EXPORT(shadowScores);

void sumShadowRow(const float* image, const float* background, size_t width, float* products,
                  const ShadowSums& sums) {
  HWY_DYNAMIC_DISPATCH(shadowSums)(image, background, width, products, sums);
}
void scoreShadowRow(const ShadowSums rows[3], size_t width, float noise_variance, float* shadow) {
  HWY_DYNAMIC_DISPATCH(shadowScores)(rows, width, noise_variance, shadow);
}

}  // namespace redbee
#endif
