// Inputs that are messages of arbitrary content: records of one byte that picks the channel, two bytes of
// length (big-endian), and so many bytes of message behind its hash. A length beyond the end takes what is
// there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::fuzz {

struct MessageTarget {
  std::string channel;
  int64_t hash;
};

inline void publish(Bus& bus, const MessageTarget& target, const uint8_t* data, size_t size) {
  std::vector<uint8_t> message;
  for (int shift = 56; shift >= 0; shift -= 8) {
    message.push_back(static_cast<uint8_t>(static_cast<uint64_t>(target.hash) >> shift));
  }
  message.insert(message.end(), data, data + size);
  bus.publish(target.channel, message);
}

/// Calls `settle` after each record's message.
template <typename Settle>
void publishRecords(Bus& bus, const std::vector<MessageTarget>& targets, const uint8_t* data, size_t size,
                    const Settle& settle) {
  while (size >= 3) {
    const size_t length = std::min(size - 3, static_cast<size_t>(data[1]) << 8 | data[2]);
    publish(bus, targets[data[0] % targets.size()], data + 3, length);
    settle();
    data += 3 + length;
    size -= 3 + length;
  }
}

}  // namespace redbee::fuzz
