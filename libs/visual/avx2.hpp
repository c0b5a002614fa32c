// What the vector code of patches shares where vectors have 32 bytes. For *_kernels.cpp, behind highway.h:
// compiled once for each set of instructions, as imaging/for_lanes.hpp is, and therefore without the usual
// guard.
#if defined(REDBEE_VISUAL_AVX2) == defined(HWY_TARGET_TOGGLE)
#ifdef REDBEE_VISUAL_AVX2
#undef REDBEE_VISUAL_AVX2
#else
#define REDBEE_VISUAL_AVX2
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

HWY_INLINE __m256i pairOf(int16_t even, int16_t odd) {
  return _mm256_set1_epi32(static_cast<int32_t>(static_cast<uint32_t>(static_cast<uint16_t>(odd)) << 16U |
                                                static_cast<uint16_t>(even)));
}

HWY_INLINE __m128i eight(const int16_t* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

HWY_INLINE int64_t total(__m256i sums) {
  HWY_ALIGN int32_t lane[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lane), sums);
  int64_t sum = 0;
  for (const int32_t value : lane) sum += value;
  return sum;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#endif
