// Encoded layout of each message type: the lengths inside a message are compared with its byte count before
// anything is allocated for them. (Decoders made by lcm-gen resize first and check afterwards.) The shapes
// are generated from lcmtypes/*.lcm: include redbee/message_types.hpp.
#pragma once

#include <cstdint>
#include <string_view>

namespace redbee {

/// Layout after the hash:
///   `12`      that many bytes;
///   `s`       a string: int32 length with the closing NUL, which is the only one;
///   `#*5`     int32 count, then so many elements of 5 bytes each (arrays that share a count are added up:
///             the order does not matter);
///   `#(...)`  int32 count, then so many groups.
/// Each type has, as lcmtypes/message_types.awk makes it:
///   kLayout                 its layout
///   countsAgree(message)    whether each count member equals the size of its arrays
///   visit(message, visitor) hands every member to visitor.value(), .count() and .resize(array, count), in
///   the
///                           order of the wire, those of nested types included
template <typename Message>
struct WireShape;

template <typename... Messages>
struct TypeList {};

/// True when `data` (what follows the hash) is laid out so, to the byte. Allocates nothing, reads nothing
/// beyond `size`.
bool matchesLayout(std::string_view layout, const uint8_t* data, int64_t size);

template <typename Count, typename... Arrays>
bool countFits(Count count, const Arrays&... arrays) {
  return count >= 0 && ((static_cast<size_t>(count) == arrays.size()) && ...);
}

template <typename Message>
bool countsAgreeIn(const Message& nested) {
  return WireShape<Message>::countsAgree(nested);
}
template <typename Array>
bool countsAgreeInEach(const Array& array) {
  for (const auto& nested : array) {
    if (!countsAgreeIn(nested)) return false;
  }
  return true;
}

}  // namespace redbee
