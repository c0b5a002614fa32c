#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/visual/template_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/visual/avx2.hpp"
#include "redbee/visual/lanes.hpp"
#include "redbee/visual/template_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

/// Eight pixels of a row, then eight of the next one.
HWY_INLINE __m256i pixelsOfTwo(const uint8_t* row, size_t stride) {
  const __m128i upper = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row));
  const __m128i lower = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + stride));
  return _mm256_cvtepu8_epi16(_mm_unpacklo_epi64(upper, lower));
}
/// Of rows `step` apart; the second is 0 where there is none.
HWY_INLINE __m256i valuesOfTwo(const int16_t* row, ptrdiff_t step, bool both) {
  const __m256i upper = _mm256_inserti128_si256(_mm256_setzero_si256(), eight(row), 0);
  return both ? _mm256_inserti128_si256(upper, eight(row + step), 1) : upper;
}
HWY_INLINE void store(__m256i values, int16_t* row, ptrdiff_t step, bool both) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(row), _mm256_castsi256_si128(values));
  if (both) _mm_storeu_si128(reinterpret_cast<__m128i*>(row + step), _mm256_extracti128_si256(values, 1));
}
HWY_INLINE __m256i maskOf(const int16_t* mask, bool both) {
  const __m256i one = _mm256_inserti128_si256(_mm256_setzero_si256(), eight(mask), 0);
  return both ? _mm256_inserti128_si256(one, eight(mask), 1) : one;
}
HWY_INLINE void addProducts(__m256i& sum, __m256i a, __m256i b) {
  sum = _mm256_add_epi32(sum, _mm256_madd_epi16(a, b));
}

bool cut(const uint8_t* first, size_t stride, const TemplateRows& rows, TemplateSums& sums) {
  const ptrdiff_t step = 8 * static_cast<ptrdiff_t>(rows.lanes);
  const __m256i one = _mm256_set1_epi16(1), zero = _mm256_setzero_si256();
  __m256i grey = zero, grey_grey = zero, sum_x = zero, sum_y = zero, x_grey = zero, y_grey = zero, xx = zero,
          xy = zero, yy = zero;
  for (int lane = 0; lane < rows.lanes; ++lane) {
    const uint8_t* p = first + 8 * lane;
    ptrdiff_t at = 8 * static_cast<ptrdiff_t>(lane);
    __m256i mask = maskOf(rows.mask + at, true);
    __m256i above = pixelsOfTwo(p - stride, stride);
    for (int row = 0; row < rows.side; row += 2, p += 2 * stride, at += 2 * step) {
      const bool both = row + 1 < rows.side;
      if (!both) mask = maskOf(rows.mask + 8 * static_cast<ptrdiff_t>(lane), false);
      const __m256i here = pixelsOfTwo(p, stride), below = pixelsOfTwo(p + stride, stride);
      const __m256i t = _mm256_and_si256(here, mask);
      const __m256i gx =
          _mm256_and_si256(_mm256_sub_epi16(pixelsOfTwo(p + 1, stride), pixelsOfTwo(p - 1, stride)), mask);
      const __m256i gy = _mm256_and_si256(_mm256_sub_epi16(below, above), mask);
      above = _mm256_permute2x128_si256(here, below, 0x31);  // the last row of either
      store(t, rows.grey + at, step, both);
      store(gx, rows.gradient_x + at, step, both);
      store(gy, rows.gradient_y + at, step, both);
      addProducts(grey, t, one);
      addProducts(grey_grey, t, t);
      addProducts(sum_x, gx, one);
      addProducts(sum_y, gy, one);
      addProducts(x_grey, gx, t);
      addProducts(y_grey, gy, t);
      addProducts(xx, gx, gx);
      addProducts(xy, gx, gy);
      addProducts(yy, gy, gy);
    }
  }
  sums = {total(grey),   total(grey_grey), total(sum_x), total(sum_y), total(x_grey),
          total(y_grey), total(xx),        total(xy),    total(yy)};
  return true;
}

HWY_INLINE __m256i projected(__m256i gradient, __m256i grey, __m256i factors, __m256i constant) {
  const auto half = [&](__m256i pairs) HWY_ATTR {
    return _mm256_srai_epi32(_mm256_add_epi32(_mm256_madd_epi16(pairs, factors), constant), kProjectBits);
  };
  return _mm256_packs_epi32(half(_mm256_unpacklo_epi16(gradient, grey)),
                            half(_mm256_unpackhi_epi16(gradient, grey)));
}

bool project(const TemplateRows& rows, const GradientProjection& by, int64_t& sum_x, int64_t& sum_y) {
  const ptrdiff_t step = 8 * static_cast<ptrdiff_t>(rows.lanes);
  const __m256i factors_x = pairOf(by.factor, by.slope_x), factors_y = pairOf(by.factor, by.slope_y);
  const __m256i constant_x = _mm256_set1_epi32(by.constant_x), constant_y = _mm256_set1_epi32(by.constant_y);
  __m256i of_x = _mm256_setzero_si256(), of_y = of_x;
  for (int lane = 0; lane < rows.lanes; ++lane) {
    ptrdiff_t at = 8 * static_cast<ptrdiff_t>(lane);
    const int16_t* const lane_mask = rows.mask + at;
    __m256i mask = maskOf(lane_mask, true);
    for (int row = 0; row < rows.side; row += 2, at += 2 * step) {
      const bool both = row + 1 < rows.side;
      if (!both) mask = maskOf(lane_mask, false);
      const __m256i t = valuesOfTwo(rows.grey + at, step, both);
      const __m256i x = valuesOfTwo(rows.gradient_x + at, step, both);
      const __m256i y = valuesOfTwo(rows.gradient_y + at, step, both);
      const __m256i gx = _mm256_and_si256(projected(x, t, factors_x, constant_x), mask);
      const __m256i gy = _mm256_and_si256(projected(y, t, factors_y, constant_y), mask);
      store(gx, rows.gradient_x + at, step, both);
      store(gy, rows.gradient_y + at, step, both);
      addProducts(of_x, t, gx);
      addProducts(of_y, t, gy);
    }
  }
  sum_x = total(of_x);
  sum_y = total(of_y);
  return true;
}

#else

bool cut(const uint8_t*, size_t, const TemplateRows&, TemplateSums&) { return false; }
bool project(const TemplateRows&, const GradientProjection&, int64_t&, int64_t&) { return false; }

#endif

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(cut);
HWY_EXPORT(project);

bool cutTemplate(const uint8_t* first, size_t stride, const TemplateRows& rows, TemplateSums& sums) {
  return HWY_DYNAMIC_DISPATCH(cut)(first, stride, rows, sums);
}
bool projectTemplate(const TemplateRows& rows, const GradientProjection& projection, int64_t& sum_x,
                     int64_t& sum_y) {
  return HWY_DYNAMIC_DISPATCH(project)(rows, projection, sum_x, sum_y);
}

}  // namespace redbee
#endif
