#include "redbee/image_codec/run_deflate.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "redbee/image_codec/huffman_code.hpp"

namespace redbee {
namespace {

constexpr size_t kLongestMatch = 258, kShortestMatch = 3;
constexpr int kEndOfBlock = 256, kSymbols = 286;
constexpr int kLongestCode = 15, kLongestLengthCode = 7;
constexpr uint32_t kAdlerBase = 65521;

/// RFC 1951, 3.2.5: the symbol of a match's length, and the bits behind it.
struct LengthCode {
  uint16_t symbol;
  uint8_t bits;
  uint8_t extra;  ///< what they hold
};

std::array<LengthCode, kLongestMatch + 1> makeLengthCodes() {
  std::array<LengthCode, kLongestMatch + 1> codes{};
  size_t length = kShortestMatch;
  for (uint16_t symbol = kEndOfBlock + 1; symbol < kSymbols - 1; ++symbol) {
    const auto bits = static_cast<uint8_t>(symbol < 265 ? 0 : (symbol - 261) / 4);
    for (size_t extra = 0; extra < size_t{1} << bits && length <= kLongestMatch; ++extra, ++length)
      codes[length] = {symbol, bits, static_cast<uint8_t>(extra)};
  }
  codes[kLongestMatch] = {kSymbols - 1, 0, 0};
  return codes;
}

const LengthCode& codeOfLength(size_t length) {
  static const auto kCodes = makeLengthCodes();
  return kCodes[length];
}

/// RFC 1951, 3.2.7: the lengths of both codes; repetitions are coded, too.
struct LengthSymbol {
  int symbol;
  uint32_t extra;
  int bits;
};

std::vector<LengthSymbol> lengthSymbols(const std::vector<uint8_t>& lengths) {
  std::vector<LengthSymbol> symbols;
  for (size_t i = 0; i < lengths.size();) {
    const uint8_t length = lengths[i];
    size_t same = 1;
    while (i + same < lengths.size() && lengths[i + same] == length) ++same;
    if (length == 0 && same >= 3) {
      same = std::min<size_t>(same, 138);
      const bool is_short = same <= 10;
      symbols.push_back(
          {is_short ? 17 : 18, static_cast<uint32_t>(same - (is_short ? 3 : 11)), is_short ? 3 : 7});
    } else if (same >= 4) {
      same = std::min<size_t>(same, 7);
      symbols.push_back({length, 0, 0});
      symbols.push_back({16, static_cast<uint32_t>(same - 4), 2});
    } else {
      same = 1;
      symbols.push_back({length, 0, 0});
    }
    i += same;
  }
  return symbols;
}

void putHeader(BitWriter& to, const HuffmanCode& code) {
  constexpr std::array<int, 19> kOrder{16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  std::vector<uint8_t> lengths = code.lengths;
  lengths.push_back(1);  // of the only distance
  const std::vector<LengthSymbol> symbols = lengthSymbols(lengths);
  std::vector<uint32_t> counts(kOrder.size(), 0);
  for (const LengthSymbol& symbol : symbols) ++counts[static_cast<size_t>(symbol.symbol)];
  const HuffmanCode of_lengths = huffmanCode(counts, kLongestLengthCode);
  to.put(1, 1);  // the last block
  to.put(2, 2);  // with its own codes
  to.put(kSymbols - 257, 5);
  to.put(0, 5);
  to.put(kOrder.size() - 4, 4);
  for (const int symbol : kOrder) to.put(of_lengths.lengths[static_cast<size_t>(symbol)], 3);
  for (const LengthSymbol& symbol : symbols) {
    of_lengths.put(to, symbol.symbol);
    to.put(symbol.extra, symbol.bits);
  }
}

/// Bytes, and kEndOfBlock + the length of a match.
class Tokens {
 public:
  void add(uint8_t value, size_t run) {
    literal(value);
    for (--run; run >= kShortestMatch;) {
      const size_t length = std::min(run, kLongestMatch);
      tokens_.push_back(static_cast<uint16_t>(kEndOfBlock + length));
      ++counts_[codeOfLength(length).symbol];
      run -= length;
    }
    for (; run > 0; --run) literal(value);
  }
  void put(BitWriter& to) {
    counts_[kEndOfBlock] = 1;
    const HuffmanCode code = huffmanCode(counts_, kLongestCode);
    putHeader(to, code);
    for (const uint16_t token : tokens_) {
      if (token < kEndOfBlock) {
        code.put(to, token);
        continue;
      }
      const LengthCode& length = codeOfLength(token - size_t{kEndOfBlock});
      code.put(to, length.symbol);
      to.put(length.extra, length.bits);
      to.put(0, 1);  // the distance, 1
    }
    code.put(to, kEndOfBlock);
    to.flush();
  }

 private:
  void literal(uint8_t value) {
    tokens_.push_back(value);
    ++counts_[value];
  }
  std::vector<uint16_t> tokens_;
  std::vector<uint32_t> counts_ = std::vector<uint32_t>(kSymbols, 0);
};

/// How often the byte at `at` follows itself, counted with it.
size_t runAt(const uint8_t* data, size_t at, size_t size) {
  const uint8_t value = data[at];
  const uint64_t repeated = 0x0101010101010101U * value;
  size_t end = at + 1;
  for (uint64_t word = 0; end + sizeof(word) <= size; end += sizeof(word)) {
    std::memcpy(&word, data + end, sizeof(word));
    if (word != repeated) break;
  }
  while (end < size && data[end] == value) ++end;
  return end - at;
}

/// Of `run` bytes of this value more.
void addToAdler(uint64_t& a, uint64_t& b, uint8_t value, uint64_t run) {
  if (run == 1) {
    a += value;
    a -= a >= kAdlerBase ? kAdlerBase : 0;
    b += a;
    b -= b >= kAdlerBase ? kAdlerBase : 0;
    return;
  }
  b = (b + run * a + value * (run * (run + 1) / 2 % kAdlerBase)) % kAdlerBase;
  a = (a + value * run) % kAdlerBase;
}

}  // namespace

std::vector<uint8_t> deflateRuns(const uint8_t* data, size_t size) {
  Tokens tokens;
  uint64_t a = 1, b = 0;
  for (size_t at = 0, run = 0; at < size; at += run) {
    run = runAt(data, at, size);
    tokens.add(data[at], run);
    addToAdler(a, b, data[at], run);
  }
  std::vector<uint8_t> bytes{0x78, 0x01};
  BitWriter writer(bytes);
  tokens.put(writer);
  for (const uint64_t half : {b, a}) {
    bytes.push_back(static_cast<uint8_t>(half >> 8U));
    bytes.push_back(static_cast<uint8_t>(half));
  }
  return bytes;
}

}  // namespace redbee
