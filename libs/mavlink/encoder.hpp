// Frames of MAVLink 2 from messages.
#pragma once

#include <cstdint>
#include <optional>

#include "redbee/mavlink/frame.hpp"
#include "redbee/mavlink/signing.hpp"

namespace redbee::mavlink {

class Encoder {
 public:
  /// Who sends.
  Encoder(uint8_t system, uint8_t component) : system_(system), component_(component) {}
  /// From now on frames are signed.
  void signWith(const Signer& signer) { signer_ = signer; }
  std::optional<Signer>& signer() { return signer_; }

  /// Each frame has the next sequence number.
  template <typename Message>
  Bytes encode(const Message& message) {
    return frameOf(kLayoutOf<Message>, payloadOf(message));
  }

 private:
  Bytes frameOf(const MessageLayout& layout, Bytes payload);

  uint8_t system_;
  uint8_t component_;
  uint8_t sequence_ = 0;
  std::optional<Signer> signer_;
};

}  // namespace redbee::mavlink
