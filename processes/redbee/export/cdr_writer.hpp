// Serialises a ROS 2 message: OMG's CDR, little-endian, with its header of four bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "redbee/files/byte_view.hpp"

namespace redbee {

class CdrWriter {
 public:
  /// An integer, float or double.
  template <typename Number>
  CdrWriter& number(Number value) {
    while ((bytes_.size() - kHeader) % sizeof(Number) != 0) bytes_.push_back(0);
    uint8_t raw[sizeof(Number)];
    std::memcpy(raw, &value, sizeof(Number));  // this machine and the bytes are little-endian
    bytes_.insert(bytes_.end(), raw, raw + sizeof(Number));
    return *this;
  }
  template <typename Number>
  CdrWriter& numbers(const Number* values, size_t count) {
    for (size_t i = 0; i < count; ++i) number(values[i]);
    return *this;
  }
  CdrWriter& string(const std::string& text) {
    number(static_cast<uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
    return *this;
  }
  /// uint8[].
  CdrWriter& data(ByteView view) {
    number(static_cast<uint32_t>(view.size));
    bytes_.insert(bytes_.end(), view.data, view.data + view.size);
    return *this;
  }
  /// builtin_interfaces/Time of a time in us, not negative.
  CdrWriter& time(int64_t utime) {
    return number(static_cast<int32_t>(utime / 1'000'000))
        .number(static_cast<uint32_t>(utime % 1'000'000 * 1000));
  }
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  static constexpr size_t kHeader = 4;
  std::vector<uint8_t> bytes_{0, 1, 0, 0};
};

}  // namespace redbee
