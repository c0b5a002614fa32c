// Decompression of blocks whose size is known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "redbee/files/byte_view.hpp"

namespace redbee {

struct Decompressed {
  std::vector<uint8_t> bytes;  ///< as far as they go
  std::string fault;           ///< empty if they are all
};

/// One or more frames of zstd (RFC 8878) or LZ4 that should give `size` bytes, which are allocated. `method`:
/// "", "zstd", "lz4"; another is a fault.
Decompressed decompress(const std::string& method, ByteView compressed, size_t size);

/// The size that a frame of zstd gives, as it states; std::nullopt for anything else, above `most`,
/// and above what its bytes can give.
std::optional<size_t> sizeOfZstdFrame(ByteView compressed, size_t most);

}  // namespace redbee
