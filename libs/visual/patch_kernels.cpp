#include "redbee/imaging/simd.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "redbee/visual/patch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "redbee/visual/avx2.hpp"
#include "redbee/visual/patch_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

/// Eight pixels of a row, each with its right neighbour.
HWY_INLINE __m256i neighbours(const uint8_t* row) {
  const __m128i left = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row));
  const __m128i right = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + 1));
  return _mm256_cvtepu8_epi16(_mm_unpacklo_epi8(left, right));
}

/// Eight of one row, eight of the next one.
HWY_INLINE __m256i two(const int16_t* upper, const int16_t* lower) {
  return _mm256_inserti128_si256(_mm256_castsi128_si256(eight(upper)), eight(lower), 1);
}

HWY_INLINE __m256i sampled(__m256i upper, __m256i lower, __m256i above, __m256i below) {
  constexpr int kShift = BilinearWeights::kWeightBits - kSampleBits;
  const __m256i half = _mm256_set1_epi32(1 << (kShift - 1));
  const __m256i sum = _mm256_add_epi32(_mm256_madd_epi16(upper, above), _mm256_madd_epi16(lower, below));
  return _mm256_srai_epi32(_mm256_add_epi32(sum, half), kShift);
}

bool samplesOf(const SampledPatch& patch, int16_t* to) {
  const __m256i above = pairOf(patch.weights.top_left, patch.weights.top_right);
  const __m256i below = pairOf(patch.weights.bottom_left, patch.weights.bottom_right);
  for (int lane = 0; lane < patch.lanes; ++lane) {
    const uint8_t* row = patch.corner + 8 * lane;
    int16_t* stored = to + 8 * lane;
    __m256i first = neighbours(row);
    for (int left = patch.side; left > 0; --left, stored += 8 * patch.lanes) {
      const __m256i second = neighbours(row += patch.stride);
      const __m256i values = sampled(first, second, above, below);
      _mm_storeu_si128(reinterpret_cast<__m128i*>(stored),
                       _mm_packs_epi32(_mm256_castsi256_si128(values), _mm256_extracti128_si256(values, 1)));
      first = second;
    }
  }
  return true;
}

bool products(const SampledPatch& patch, const int16_t* gradient_x, const int16_t* gradient_y,
              PatchProducts& sums) {
  const __m256i above = pairOf(patch.weights.top_left, patch.weights.top_right);
  const __m256i below = pairOf(patch.weights.bottom_left, patch.weights.bottom_right);
  const auto between = [&](__m256i upper, __m256i lower)
                           HWY_ATTR { return sampled(upper, lower, above, below); };
  const ptrdiff_t step = 8 * static_cast<ptrdiff_t>(patch.lanes);  // from row to row of the gradients
  __m256i sum_x = _mm256_setzero_si256(), sum_y = sum_x;
  for (int lane = 0; lane < patch.lanes; ++lane) {
    const uint8_t* row = patch.corner + 8 * lane;
    const int16_t* x = gradient_x + 8 * lane;
    const int16_t* y = gradient_y + 8 * lane;
    __m256i first = neighbours(row);
    int left = patch.side;
    for (; left >= 2; left -= 2, x += 2 * step, y += 2 * step) {
      const __m256i second = neighbours(row += patch.stride), third = neighbours(row += patch.stride);
      const __m256i packed = _mm256_packs_epi32(between(first, second), between(second, third));
      const __m256i samples = _mm256_permute4x64_epi64(packed, 0xD8);  // row by row
      sum_x = _mm256_add_epi32(sum_x, _mm256_madd_epi16(samples, two(x, x + step)));
      sum_y = _mm256_add_epi32(sum_y, _mm256_madd_epi16(samples, two(y, y + step)));
      first = third;
    }
    if (left == 0) continue;
    const __m256i last = between(first, neighbours(row + patch.stride));
    const __m128i samples = _mm_packs_epi32(_mm256_castsi256_si128(last), _mm256_extracti128_si256(last, 1));
    const auto alone = [&](const int16_t* gradient) HWY_ATTR {
      return _mm256_inserti128_si256(_mm256_setzero_si256(), _mm_madd_epi16(samples, eight(gradient)), 0);
    };
    sum_x = _mm256_add_epi32(sum_x, alone(x));
    sum_y = _mm256_add_epi32(sum_y, alone(y));
  }
  sums = {total(sum_x), total(sum_y)};
  return true;
}

#else

bool products(const SampledPatch&, const int16_t*, const int16_t*, PatchProducts&) { return false; }
bool samplesOf(const SampledPatch&, int16_t*) { return false; }

#endif

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace redbee {

HWY_EXPORT(products);
HWY_EXPORT(samplesOf);

bool sampleProducts(const SampledPatch& patch, const int16_t* gradient_x, const int16_t* gradient_y,
                    PatchProducts& sums) {
  return HWY_DYNAMIC_DISPATCH(products)(patch, gradient_x, gradient_y, sums);
}
bool storeSamples(const SampledPatch& patch, int16_t* samples) {
  return HWY_DYNAMIC_DISPATCH(samplesOf)(patch, samples);
}

}  // namespace redbee
#endif
