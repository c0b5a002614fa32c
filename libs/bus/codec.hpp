// Encoding and decoding of messages; received bytes are not trusted.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "redbee/message_types.hpp"

namespace redbee {

/// Bytes of the hash that every LCM message starts with.
constexpr int kHashBytes = 8;

/// True if the first eight of `size` bytes are this hash (big-endian).
bool startsWithHash(const uint8_t* data, int size, int64_t hash);

/// Throws std::invalid_argument where a count member disagrees with its array or a string holds a NUL.
template <typename Message>
std::vector<uint8_t> encodeMessage(const Message& message) {
  if (!WireShape<Message>::countsAgree(message)) {
    throw std::invalid_argument(std::string(Message::getTypeName()) + ": a count disagrees with its array");
  }
  std::vector<uint8_t> data(static_cast<size_t>(message.getEncodedSize()));
  const int size = static_cast<int>(data.size());
  if (message.encode(data.data(), 0, size) != size) {
    throw std::invalid_argument(std::string(Message::getTypeName()) + ": cannot be encoded");
  }
  return data;
}

/// Returns false, and leaves `message` unspecified, unless the bytes are exactly one message of this type.
/// Does not throw; allocates at most a small multiple of `size`, whatever lengths the message declares.
template <typename Message>
bool decodeMessage(const uint8_t* data, int size, Message& message) {
  if (!startsWithHash(data, size, Message::getHash())) return false;
  if (!matchesLayout(WireShape<Message>::kLayout, data + kHashBytes, size - kHashBytes)) return false;
  return message.decode(data, 0, size) == size;
}

}  // namespace redbee
