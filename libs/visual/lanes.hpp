// Eight 16-bit integers at once for the patch alignment: SSE2 where the processor has it, plain loops
// elsewhere. Both do the same integer arithmetic, so their results are identical.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace redbee {

/// Fixed-point weights of the four neighbours of a bilinear sample, their sum 1 << kWeightBits.
struct BilinearWeights {
  static constexpr int kWeightBits = 14;
  int16_t top_left, top_right, bottom_left, bottom_right;
};

/// Fractional bits of a bilinear sample: grey levels times 32.
inline constexpr int kSampleBits = 5;
/// Fractional bits of the factors in project().
inline constexpr int kProjectBits = 8;

struct PortableLanes {
  static constexpr bool kMayBeLonger = false;  ///< a processor may have longer vectors (patch_kernels.hpp)
  using I16 = std::array<int16_t, 8>;
  using I32 = std::array<int32_t, 4>;

  static I32 zero() { return I32{}; }
  static I16 load(const int16_t* from) {
    I16 a;
    std::memcpy(a.data(), from, sizeof(a));
    return a;
  }
  static void store(int16_t* to, const I16& a) { std::memcpy(to, a.data(), sizeof(a)); }
  static I16 loadBytes(const uint8_t* from) {
    I16 a;
    for (int i = 0; i < 8; ++i) a[i] = from[i];
    return a;
  }
  static I16 spread(int16_t value) {
    I16 a;
    a.fill(value);
    return a;
  }
  static I16 subtract(const I16& a, const I16& b) {
    I16 c;
    for (int i = 0; i < 8; ++i) c[i] = static_cast<int16_t>(a[i] - b[i]);
    return c;
  }
  /// Low 16 bits of the products.
  static I16 multiply(const I16& a, const I16& b) {
    I16 c;
    for (int i = 0; i < 8; ++i) c[i] = static_cast<int16_t>(a[i] * b[i]);
    return c;
  }
  static I16 mask(const I16& a, const I16& b) {
    I16 c;
    for (int i = 0; i < 8; ++i) c[i] = static_cast<int16_t>(a[i] & b[i]);
    return c;
  }
  static I16 magnitude(const I16& a) {
    I16 c;
    for (int i = 0; i < 8; ++i) c[i] = static_cast<int16_t>(a[i] < 0 ? -a[i] : a[i]);
    return c;
  }
  /// sums + products of a and b, neighbours added pairwise.
  static I32 addProducts(const I32& sums, const I16& a, const I16& b) {
    I32 c;
    for (int i = 0; i < 4; ++i) c[i] = sums[i] + a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1];
    return c;
  }
  static int64_t total(const I32& a) { return int64_t{a[0]} + a[1] + a[2] + a[3]; }
  /// Bilinear samples (kSampleBits) between the rows that begin at `top` and `bottom`; reads nine bytes of
  /// each.
  static I16 sample(const uint8_t* top, const uint8_t* bottom, const BilinearWeights& w) {
    constexpr int kShift = BilinearWeights::kWeightBits - kSampleBits;
    I16 a;
    for (int i = 0; i < 8; ++i) {
      const int32_t sum = w.top_left * top[i] + w.top_right * top[i + 1] + w.bottom_left * bottom[i] +
                          w.bottom_right * bottom[i + 1];
      a[i] = static_cast<int16_t>((sum + (1 << (kShift - 1))) >> kShift);
    }
    return a;
  }
  /// (factor_a * a + factor_b * b + offset) >> kProjectBits, saturated.
  static I16 project(const I16& a, int16_t factor_a, const I16& b, int16_t factor_b, int32_t offset) {
    I16 c;
    for (int i = 0; i < 8; ++i) {
      const int32_t value = (a[i] * factor_a + b[i] * factor_b + offset) >> kProjectBits;
      c[i] = static_cast<int16_t>(value > INT16_MAX ? INT16_MAX : value < INT16_MIN ? INT16_MIN : value);
    }
    return c;
  }
};

#if defined(__SSE2__)
struct Sse2Lanes {
  static constexpr bool kMayBeLonger = true;
  using I16 = __m128i;
  using I32 = __m128i;

  static I32 zero() { return _mm_setzero_si128(); }
  static I16 load(const int16_t* from) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)); }
  static void store(int16_t* to, I16 a) { _mm_storeu_si128(reinterpret_cast<__m128i*>(to), a); }
  static I16 loadBytes(const uint8_t* from) {
    return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)), _mm_setzero_si128());
  }
  static I16 spread(int16_t value) { return _mm_set1_epi16(value); }
  static I16 subtract(I16 a, I16 b) { return _mm_sub_epi16(a, b); }
  static I16 multiply(I16 a, I16 b) { return _mm_mullo_epi16(a, b); }
  static I16 mask(I16 a, I16 b) { return _mm_and_si128(a, b); }
  static I16 magnitude(I16 a) { return _mm_max_epi16(a, _mm_sub_epi16(_mm_setzero_si128(), a)); }
  static I32 addProducts(I32 sums, I16 a, I16 b) { return _mm_add_epi32(sums, _mm_madd_epi16(a, b)); }
  static int64_t total(I32 a) {
    alignas(16) int32_t lane[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(lane), a);
    return int64_t{lane[0]} + lane[1] + lane[2] + lane[3];
  }
  static I16 sample(const uint8_t* top, const uint8_t* bottom, const BilinearWeights& w) {
    constexpr int kShift = BilinearWeights::kWeightBits - kSampleBits;
    const I16 above = pairs(w.top_left, w.top_right);
    const I16 below = pairs(w.bottom_left, w.bottom_right);
    const __m128i zeros = _mm_setzero_si128();
    const __m128i half = _mm_set1_epi32(1 << (kShift - 1));
    const __m128i upper = neighbours(top);
    const __m128i lower = neighbours(bottom);
    const __m128i first = _mm_add_epi32(_mm_madd_epi16(_mm_unpacklo_epi8(upper, zeros), above),
                                        _mm_madd_epi16(_mm_unpacklo_epi8(lower, zeros), below));
    const __m128i second = _mm_add_epi32(_mm_madd_epi16(_mm_unpackhi_epi8(upper, zeros), above),
                                         _mm_madd_epi16(_mm_unpackhi_epi8(lower, zeros), below));
    return _mm_packs_epi32(_mm_srai_epi32(_mm_add_epi32(first, half), kShift),
                           _mm_srai_epi32(_mm_add_epi32(second, half), kShift));
  }
  static I16 project(I16 a, int16_t factor_a, I16 b, int16_t factor_b, int32_t offset) {
    const I16 factors = pairs(factor_a, factor_b);
    const __m128i offsets = _mm_set1_epi32(offset);
    const __m128i first = _mm_add_epi32(_mm_madd_epi16(_mm_unpacklo_epi16(a, b), factors), offsets);
    const __m128i second = _mm_add_epi32(_mm_madd_epi16(_mm_unpackhi_epi16(a, b), factors), offsets);
    return _mm_packs_epi32(_mm_srai_epi32(first, kProjectBits), _mm_srai_epi32(second, kProjectBits));
  }

 private:
  static I16 pairs(int16_t even, int16_t odd) {
    return _mm_set1_epi32(static_cast<int32_t>((static_cast<uint32_t>(static_cast<uint16_t>(odd)) << 16) |
                                               static_cast<uint16_t>(even)));
  }
  static __m128i neighbours(const uint8_t* row) {
    return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(row)),
                             _mm_loadl_epi64(reinterpret_cast<const __m128i*>(row + 1)));
  }
};
using NativeLanes = Sse2Lanes;
#else
using NativeLanes = PortableLanes;
#endif

}  // namespace redbee
