// Bytes currently allocated. Unlike resident memory this excludes a sanitizer's shadow memory and quarantine.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define REDBEE_SANITIZER_ALLOCATES
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define REDBEE_SANITIZER_ALLOCATES
#endif

#ifdef REDBEE_SANITIZER_ALLOCATES
// GCC has the function, but not clang's <sanitizer/allocator_interface.h>.
extern "C" size_t __sanitizer_get_current_allocated_bytes();
#else
#include <malloc.h>
#endif

namespace redbee::test {

inline int64_t allocatedBytes() {
#ifdef REDBEE_SANITIZER_ALLOCATES
  return static_cast<int64_t>(__sanitizer_get_current_allocated_bytes());
#else
  const struct mallinfo2 info = mallinfo2();
  return static_cast<int64_t>(info.uordblks + info.hblkhd);
#endif
}

}  // namespace redbee::test
