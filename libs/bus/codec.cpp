#include "redbee/bus/codec.hpp"

#include <cctype>
#include <cstring>
#include <optional>

namespace redbee {
namespace {

uint32_t bigEndian32(const uint8_t* data) {
  return static_cast<uint32_t>(data[0]) << 24 | static_cast<uint32_t>(data[1]) << 16 |
         static_cast<uint32_t>(data[2]) << 8 | static_cast<uint32_t>(data[3]);
}

/// Walks through a layout and the bytes together; each step fails instead of reading past the end of the
/// bytes.
class LayoutWalker {
 public:
  LayoutWalker(const uint8_t* data, int64_t size) : data_(data), left_(size) {}

  int64_t left() const { return left_; }

  bool walk(std::string_view layout) {
    while (!layout.empty()) {
      if (!walkItem(layout)) return false;
    }
    return true;
  }

 private:
  /// Removes and returns the first item of `layout`.
  bool walkItem(std::string_view& layout) {
    const char first = layout.front();
    if (std::isdigit(static_cast<unsigned char>(first)) != 0) return skip(takeNumber(layout));
    layout.remove_prefix(1);
    if (first == 's') return skipString();
    if (first == '#') return walkRepeated(layout);
    return first == ' ';
  }

  bool walkRepeated(std::string_view& layout) {
    const auto count = readLength();
    if (!count) return false;
    const char kind = layout.front();
    layout.remove_prefix(1);
    if (kind == '*') return skip(*count * takeNumber(layout));
    const size_t end = layout.find(')');
    const std::string_view group = layout.substr(0, end);
    layout.remove_prefix(end + 1);
    for (int64_t i = 0; i < *count; ++i) {
      if (!walk(group)) return false;
    }
    return true;
  }

  bool skipString() {
    const auto length = readLength();
    if (!length || *length < 1 || *length > left_) return false;
    const void* closing = std::memchr(data_, 0, static_cast<size_t>(*length));
    return closing == data_ + *length - 1 && skip(*length);
  }

  std::optional<int64_t> readLength() {
    if (left_ < 4) return std::nullopt;
    const auto length = static_cast<int32_t>(bigEndian32(data_));
    skip(4);
    if (length < 0) return std::nullopt;
    return length;
  }

  bool skip(int64_t bytes) {
    if (bytes > left_) return false;
    data_ += bytes;
    left_ -= bytes;
    return true;
  }

  static int64_t takeNumber(std::string_view& layout) {
    int64_t number = 0;
    while (!layout.empty() && std::isdigit(static_cast<unsigned char>(layout.front())) != 0) {
      number = number * 10 + (layout.front() - '0');
      layout.remove_prefix(1);
    }
    return number;
  }

  const uint8_t* data_;
  int64_t left_;
};

}  // namespace

bool matchesLayout(std::string_view layout, const uint8_t* data, int64_t size) {
  LayoutWalker walker(data, size);
  return walker.walk(layout) && walker.left() == 0;
}

bool startsWithHash(const uint8_t* data, int size, int64_t hash) {
  if (size < kHashBytes) return false;
  const uint64_t high = bigEndian32(data);
  const uint64_t low = bigEndian32(data + 4);
  return (high << 32 | low) == static_cast<uint64_t>(hash);
}

}  // namespace redbee
