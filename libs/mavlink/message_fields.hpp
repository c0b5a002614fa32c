// What follows from the fields of a message: lengths, CRC_EXTRA, and its payload
// (mavlink.io/en/guide/serialization.html).
//
// A message is a struct with kId, kName and a static visit(message, visitor) that passes every field, by its
// name in the definition, in wire order: those of the base message by the size of their type, largest first,
// then extensions(), then the extensions in the order of the definition.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "redbee/mavlink/crc.hpp"

namespace redbee::mavlink {

/// The size of a field that is no array counts as 0.
template <typename T>
struct FieldType {
  using Element = T;
  static constexpr size_t kArray = 0;
};
template <typename T, size_t kSize>
struct FieldType<std::array<T, kSize>> {
  using Element = T;
  static constexpr size_t kArray = kSize;
};

/// The type's name in the definitions.
template <typename T>
constexpr std::string_view wireName() {
  if constexpr (std::is_same_v<T, float>) {
    return "float";
  } else if constexpr (std::is_same_v<T, char>) {
    return "char";
  } else {
    constexpr std::string_view names[] = {"uint8_t", "uint16_t", "uint32_t", "uint64_t",
                                          "int8_t",  "int16_t",  "int32_t",  "int64_t"};
    constexpr size_t power = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return names[power + (std::is_signed_v<T> ? 4 : 0)];
  }
}

/// What identifies a message on the wire.
struct MessageLayout {
  uint32_t id = 0;
  uint8_t crc_extra = 0;
  uint8_t min_length = 0;  ///< bytes, without extensions: the length of MAVLink 1
  uint8_t max_length = 0;  ///< bytes, with them
};

/// CRC_EXTRA is the folded checksum over name and base fields in wire order.
class LayoutVisitor {
 public:
  constexpr explicit LayoutVisitor(std::string_view name) : crc_(crcOf(" ", crcOf(name, kCrcStart))) {}
  template <typename T>
  constexpr void operator()(std::string_view name, const T&) {
    using Element = typename FieldType<T>::Element;
    length_ += sizeof(T);
    if (is_extension_) return;
    is_ordered_ = is_ordered_ && sizeof(Element) <= last_size_;
    last_size_ = sizeof(Element);
    crc_ = crcOf(" ", crcOf(name, crcOf(" ", crcOf(wireName<Element>(), crc_))));
    if (FieldType<T>::kArray > 0) crc_ = crcOf(static_cast<uint8_t>(FieldType<T>::kArray), crc_);
    min_length_ = length_;
  }
  constexpr void extensions() { is_extension_ = true; }
  constexpr bool isOrdered() const { return is_ordered_; }
  constexpr MessageLayout layout(uint32_t id) const {
    return {id, static_cast<uint8_t>((crc_ & 0xff) ^ (crc_ >> 8)), static_cast<uint8_t>(min_length_),
            static_cast<uint8_t>(length_)};
  }

 private:
  uint16_t crc_;
  size_t length_ = 0;
  size_t min_length_ = 0;
  size_t last_size_ = sizeof(uint64_t);
  bool is_extension_ = false;
  bool is_ordered_ = true;
};

template <typename Message>
constexpr LayoutVisitor visitedLayout() {
  LayoutVisitor visitor(Message::kName);
  const Message message{};
  Message::visit(message, visitor);
  return visitor;
}
template <typename Message>
inline constexpr MessageLayout kLayoutOf = visitedLayout<Message>().layout(Message::kId);

/// Little-endian, whatever the machine is.
class PayloadWriter {
 public:
  template <typename T>
  void operator()(std::string_view, const T& field) {
    if constexpr (FieldType<T>::kArray > 0) {
      for (const auto element : field) put(element);
    } else {
      put(field);
    }
  }
  void extensions() {}
  const std::vector<uint8_t>& bytes() const { return bytes_; }

 private:
  template <typename T>
  void put(T value) {
    uint64_t bits = 0;
    if constexpr (std::is_same_v<T, float>) {
      uint32_t word = 0;
      std::memcpy(&word, &value, sizeof word);
      bits = word;
    } else {
      bits = static_cast<std::make_unsigned_t<T>>(value);
    }
    for (size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<uint8_t>(bits >> (8 * i)));
  }

  std::vector<uint8_t> bytes_;
};

/// Bytes beyond the payload's end are the zeros that MAVLink 2 leaves out.
class PayloadReader {
 public:
  PayloadReader(const uint8_t* data, size_t size) : data_(data), size_(size) {}
  template <typename T>
  void operator()(std::string_view, T& field) {
    if constexpr (FieldType<T>::kArray > 0) {
      for (auto& element : field) take(element);
    } else {
      take(field);
    }
  }
  void extensions() {}

 private:
  template <typename T>
  void take(T& value) {
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof(T); ++i, ++at_) {
      if (at_ < size_) bits |= uint64_t{data_[at_]} << (8 * i);
    }
    if constexpr (std::is_same_v<T, float>) {
      const auto word = static_cast<uint32_t>(bits);
      std::memcpy(&value, &word, sizeof word);
    } else {
      value = static_cast<T>(bits);
    }
  }

  const uint8_t* data_;
  size_t size_;
  size_t at_ = 0;
};

template <typename Message>
std::vector<uint8_t> payloadOf(const Message& message) {
  PayloadWriter writer;
  Message::visit(message, writer);
  return writer.bytes();
}
template <typename Message>
Message messageFrom(const uint8_t* payload, size_t size) {
  Message message{};
  PayloadReader reader(payload, size);
  Message::visit(message, reader);
  return message;
}

}  // namespace redbee::mavlink
