#include "redbee/files/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace redbee {
namespace {

uint8_t byteAt(const std::string& text, size_t at) { return static_cast<uint8_t>(text[at]); }

/// Bytes of the UTF-8 character at `at`, without those that are a form too long; 0 where there is none.
size_t lengthOfCharacter(const std::string& text, size_t at) {
  const uint8_t first = byteAt(text, at);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xC2 && first < 0xE0   ? 2
                        : first >= 0xE0 && first < 0xF0 ? 3
                        : first >= 0xF0 && first < 0xF5 ? 4
                                                        : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byteAt(text, at + i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// C0, DEL, and C1, which some terminals take for escape sequences.
bool isControl(const std::string& text, size_t at) {
  const uint8_t first = byteAt(text, at);
  return first < 0x20 || first == 0x7F || (first == 0xC2 && byteAt(text, at + 1) < 0xA0);
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t length = lengthOfCharacter(text, at);
    const size_t count = std::max<size_t>(length, 1);
    if (length > 0 && !isControl(text, at)) {
      out.append(text, at, count);
    } else {
      for (size_t i = 0; i < count; ++i) {
        std::array<char, 5> code{};
        std::snprintf(code.data(), code.size(), "\\x%02x", byteAt(text, at + i));
        out += code.data();
      }
    }
    at += count;
  }
  return out;
}

std::string firstTenOf(const std::vector<std::string>& names, const std::string& separator) {
  constexpr size_t kMost = 10;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i == 0 ? "" : separator) + names[i];
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

}  // namespace redbee
