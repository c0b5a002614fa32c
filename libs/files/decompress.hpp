// Decompression of blocks whose size is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "redbee/files/byte_view.hpp"

namespace redbee {

/// One or more frames of zstd (RFC 8878) or LZ4 that give `size` bytes, which are allocated. Throws
/// std::runtime_error with the reason if they do not, or if `method` ("", "zstd", "lz4") is another.
std::vector<uint8_t> decompress(const std::string& method, ByteView compressed, size_t size);

}  // namespace redbee
