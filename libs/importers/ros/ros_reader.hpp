// Reads the fields of a serialised ROS message, ROS 1's or ROS 2's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "redbee/files/byte_view.hpp"

namespace redbee {

enum class RosEncoding {
  kRos1,  ///< wiki.ros.org/roscpp/Overview/MessagesSerializationAndAdaptingTypes: little-endian, packed
  kCdr,   ///< ROS 2: OMG's CDR with its header of four bytes, either byte order; plain CDR 2 as well
};

/// The bytes are no message of the type that they should be. what() is part of a line.
class RosMessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Every read throws RosMessageError at the end of the bytes; lengths are compared with what is left before
/// anything is allocated.
class RosReader {
 public:
  RosReader(ByteView bytes, RosEncoding encoding) : bytes_(bytes), encoding_(encoding) {
    if (encoding == RosEncoding::kCdr) readCdrHeader();
  }

  RosEncoding encoding() const { return encoding_; }

  /// An integer, float or double.
  template <typename Number>
  Number number() {
    align(sizeof(Number));
    const uint8_t* from = take(sizeof(Number));
    uint8_t native[sizeof(Number)];
    for (size_t i = 0; i < sizeof(Number); ++i) native[i] = from[is_big_endian_ ? sizeof(Number) - 1 - i : i];
    Number value;
    std::memcpy(&value, native, sizeof(Number));
    return value;
  }

  std::string string() {
    auto length = number<uint32_t>();
    const auto* text = reinterpret_cast<const char*>(take(length));
    if (encoding_ == RosEncoding::kCdr && length > 0 && text[length - 1] == '\0') --length;
    return {text, length};
  }

  /// Of uint8[].
  ByteView bytes() {
    const auto length = number<uint32_t>();
    return {take(length), length};
  }

  /// Number of elements of an array of numbers that follow.
  size_t count(size_t element_bytes) {
    const auto elements = number<uint32_t>();
    if (elements > left() / element_bytes) throw RosMessageError("is cut short");
    return elements;
  }

  size_t left() const { return bytes_.size - position_; }

 private:
  void readCdrHeader() {
    const uint8_t* header = take(4);
    const int kind = header[1];
    constexpr int kCdrBig = 0, kCdrLittle = 1, kCdr2Big = 6, kCdr2Little = 7;
    if (header[0] != 0 || (kind != kCdrBig && kind != kCdrLittle && kind != kCdr2Big && kind != kCdr2Little))
      throw RosMessageError("does not start like CDR");
    is_big_endian_ = kind == kCdrBig || kind == kCdr2Big;
    most_alignment_ = kind == kCdr2Big || kind == kCdr2Little ? 4 : 8;
    origin_ = position_;
  }

  void align(size_t size) {
    if (encoding_ == RosEncoding::kRos1) return;
    const size_t alignment = size < most_alignment_ ? size : most_alignment_;
    const size_t over = (position_ - origin_) % alignment;
    if (over != 0) take(alignment - over);
  }

  const uint8_t* take(size_t count) {
    if (count > left()) throw RosMessageError("is cut short");
    const uint8_t* start = bytes_.data + position_;
    position_ += count;
    return start;
  }

  ByteView bytes_;
  RosEncoding encoding_;
  bool is_big_endian_ = false;
  size_t most_alignment_ = 8;
  size_t origin_ = 0;
  size_t position_ = 0;
};

}  // namespace redbee
