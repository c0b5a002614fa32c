// Huffman codes as RFC 1951 writes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace redbee {

/// The lowest bits of a byte first.
class BitWriter {
 public:
  explicit BitWriter(std::vector<uint8_t>& to) : to_(to) {}
  void put(uint32_t value, int bits) {
    buffer_ |= static_cast<uint64_t>(value) << filled_;
    filled_ += bits;
    if (filled_ < 32) return;
    for (int i = 0; i < 4; ++i)
      to_.push_back(static_cast<uint8_t>(buffer_ >> (8U * static_cast<unsigned>(i))));
    buffer_ >>= 32U;
    filled_ -= 32;
  }
  void flush() {
    for (; filled_ > 0; filled_ -= 8, buffer_ >>= 8U) to_.push_back(static_cast<uint8_t>(buffer_));
    filled_ = 0;
  }

 private:
  std::vector<uint8_t>& to_;
  uint64_t buffer_ = 0;
  int filled_ = 0;
};

/// A canonical Huffman code.
struct HuffmanCode {
  std::vector<uint8_t> lengths;
  std::vector<uint16_t> bits;  ///< in the order in which they are written

  void put(BitWriter& to, int symbol) const {
    to.put(bits[static_cast<size_t>(symbol)], lengths[static_cast<size_t>(symbol)]);
  }
};

/// Of the symbols that occur; two or more must. No code is longer than `longest` bits, of which there must be
/// enough for all.
HuffmanCode huffmanCode(const std::vector<uint32_t>& counts, int longest);

}  // namespace redbee
