// Whether a datagram comes from whom a link is meant to speak with.
#pragma once

#include <cstdint>
#include <optional>

#include "redbee/mavlink/parser.hpp"
#include "redbee/mavlink/signing.hpp"

namespace redbee::mavlink {

/// Whether it holds a whole frame of this system (std::nullopt: of any), with the right checksum and, where a
/// key is given, a right signature. A recorded frame passes here; what a session then believes, it decides.
inline bool holdsFrameOf(const Bytes& datagram, std::optional<uint8_t> system,
                         const std::optional<SigningKey>& key) {
  Parser parser;
  parser.feed(datagram.data(), datagram.size());
  parser.endOfDatagram();
  while (const auto frame = parser.next()) {
    if (system && frame->system != *system) continue;
    if (!key || SignatureCheck(*key, 0).accepts(*frame)) return true;
  }
  return false;
}

}  // namespace redbee::mavlink
