// Before highway.h in every source of vector code (*_kernels.cpp). Such a source is compiled once per set of
// instructions; the best that the processor has is taken at run time. All of them round alike: additions and
// multiplications are never fused.
#pragma once

#undef HWY_DISABLED_TARGETS
#undef HWY_BROKEN_EMU128
// Little is gained by the first two over SSE4 and AVX-512, and each costs a compilation. A vector of SVE,
// whose length is known at run time alone, cannot be the member of a struct; processors that have it have
// NEON.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
// Processors without any of them run plain loops over 16 bytes. GCC before 12.3 compiles those of a high half
// of products wrongly (its bug 106322), which no kernel here uses.
#define HWY_BROKEN_EMU128 0
