// A zlib stream (RFC 1950, 1951) of runs: what zlib's own Z_RLE strategy finds, bytes and repetitions of the
// byte before, at a cost that grows with the number of runs rather than of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace redbee {

std::vector<uint8_t> deflateRuns(const uint8_t* data, size_t size);

}  // namespace redbee
