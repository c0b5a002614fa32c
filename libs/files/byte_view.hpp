#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// Bytes that somebody else owns.
struct ByteView {
  const uint8_t* data = nullptr;
  size_t size = 0;
};

}  // namespace redbee
