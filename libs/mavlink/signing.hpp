// Signatures of MAVLink 2: the first 48 bits of SHA-256 over key, frame, link and timestamp
// (mavlink.io/en/guide/message_signing.html).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>

#include "redbee/mavlink/frame.hpp"

namespace redbee::mavlink {

using SigningKey = std::array<uint8_t, 32>;
/// From 64 hexadecimal digits, with white space around them; std::nullopt for anything else.
std::optional<SigningKey> signingKeyOf(std::string_view text);

/// Units of 10 us since 2015-01-01, of 48 bits.
using SigningTime = uint64_t;
/// From microseconds since 1970 [us]; 0 before 2015, as on a computer whose clock was never set.
SigningTime signingTimeOf(int64_t utc_us);

class Signer {
 public:
  Signer(const SigningKey& key, uint8_t link, SigningTime now) : key_(key), link_(link), time_(now) {}
  /// Appends the signature to a frame whose flags announce one. Each signature has a later timestamp.
  void sign(Bytes& frame);
  /// The time has advanced; it never goes back.
  void advanceTo(SigningTime now) { time_ = now > time_ ? now : time_; }
  SigningTime time() const { return time_; }

 private:
  SigningKey key_;
  uint8_t link_;
  SigningTime time_;
};

/// Accepts a frame whose signature is right and whose timestamp is later than that of the sender's frame
/// before: a recorded frame is not accepted again. A sender's first may be a minute older than the latest
/// time that was seen.
class SignatureCheck {
 public:
  static constexpr SigningTime kMaxAge = 6'000'000;  ///< a minute

  SignatureCheck(const SigningKey& key, SigningTime now) : key_(key), now_(now) {}
  void advanceTo(SigningTime now) { now_ = now > now_ ? now : now_; }
  bool accepts(const Frame& frame);
  SigningTime time() const { return now_; }

 private:
  using Stream = std::tuple<uint8_t, uint8_t, uint8_t>;  ///< system, component, link
  static constexpr size_t kMostStreams = 64;             ///< only holders of the key make one

  SigningKey key_;
  SigningTime now_;
  std::map<Stream, SigningTime> latest_;
};

}  // namespace redbee::mavlink
