// A row in steps of whole vectors, and its rest value by value. For *_kernels.cpp, behind highway.h: compiled
// once for each set of instructions, as they are, and therefore without the usual guard.
#if defined(REDBEE_IMAGING_FOR_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef REDBEE_IMAGING_FOR_LANES
#undef REDBEE_IMAGING_FOR_LANES
#else
#define REDBEE_IMAGING_FOR_LANES
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace redbee {
namespace HWY_NAMESPACE {

/// Calls `work(d, i)` with the tag of the values and the first place of each step.
template <typename T, typename Work>
HWY_INLINE void forLanes(size_t width, const Work& work) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<T> d;
  size_t i = 0;
  for (; i + hn::Lanes(d) <= width; i += hn::Lanes(d)) work(d, i);
  for (; i < width; ++i) work(hn::CappedTag<T, 1>(), i);
}

}  // namespace HWY_NAMESPACE
}  // namespace redbee
HWY_AFTER_NAMESPACE();

#endif
