// Whether frames are believed, where they are signed.
#pragma once

#include <cstdint>
#include <optional>

#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/signing.hpp"

namespace redbee::mavlink {

/// Without a key every frame is. With one, what the encoder sends is signed, and only signed frames are
/// believed, each once.
class Trust {
 public:
  /// `now`: of the signatures.
  Trust(const std::optional<SigningKey>& key, SigningTime now, Encoder& encoder) : start_(now) {
    if (!key) return;
    encoder.signWith(Signer(*key, 0, now));
    signatures_.emplace(*key, now);
  }
  bool accepts(const Frame& frame, Encoder& encoder) {
    if (!signatures_) return true;
    if (!frame.is_signed) {
      ++unsigned_frames_;
      return false;
    }
    if (!signatures_->accepts(frame)) {
      ++bad_signatures_;
      return false;
    }
    encoder.signer()->advanceTo(signatures_->time());
    return true;
  }
  /// Our clock [ns] has advanced.
  void advanceTo(int64_t host_ns, Encoder& encoder) {
    if (!signatures_) return;
    if (!since_ns_) since_ns_ = host_ns;
    const SigningTime now = start_ + static_cast<SigningTime>((host_ns - *since_ns_) / 10'000);
    signatures_->advanceTo(now);
    encoder.signer()->advanceTo(now);
  }
  int64_t unsignedFrames() const { return unsigned_frames_; }
  /// Another key, or recorded earlier.
  int64_t badSignatures() const { return bad_signatures_; }

 private:
  std::optional<SignatureCheck> signatures_;
  SigningTime start_;
  std::optional<int64_t> since_ns_;  ///< our clock at start_
  int64_t unsigned_frames_ = 0;
  int64_t bad_signatures_ = 0;
};

}  // namespace redbee::mavlink
