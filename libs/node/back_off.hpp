// Pauses between the attempts to open a device that is not there.
#pragma once

#include <algorithm>
#include <cstdint>

namespace redbee {

/// A tenth of a second, then twice as long each time, up to five seconds.
class BackOff {
 public:
  bool isDue(int64_t now_ns) const { return now_ns >= next_ns_; }
  /// An attempt has failed, or the device has gone.
  void postpone(int64_t now_ns) {
    next_ns_ = now_ns + pause_ns_;
    pause_ns_ = std::min(2 * pause_ns_, kLongestPause_ns);
  }
  /// The device works: the next pause is the shortest again.
  void reset() { pause_ns_ = kFirstPause_ns; }

 private:
  static constexpr int64_t kFirstPause_ns = 100'000'000;
  static constexpr int64_t kLongestPause_ns = 5'000'000'000;

  int64_t pause_ns_ = kFirstPause_ns;
  int64_t next_ns_ = 0;
};

}  // namespace redbee
