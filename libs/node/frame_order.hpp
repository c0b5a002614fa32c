// The order of frames in time: one rule for all nodes, so that they agree.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace redbee {

enum class FrameDecision { kNext, kDiscard, kRestart };

/// A frame that is not newer than the last one came late or twice and is left out, unless time itself was set
/// back: then the frames go on from an earlier time, and after `kRestartAfter` of them in a row, each newer
/// than the one before, they are accepted.
class FrameOrder {
 public:
  static constexpr int kRestartAfter = 5;
  /// us: a frame this far in the past is a clock that was set back, at once.
  static constexpr int64_t kSetBack = 2'000'000;

  FrameDecision classify(int64_t utime) {
    if (!last_ || utime > *last_) return accept(utime, FrameDecision::kNext);
    in_a_row_ = utime > discarded_ ? in_a_row_ + 1 : 1;
    discarded_ = utime;
    if (in_a_row_ >= kRestartAfter || *last_ - utime > kSetBack)
      return accept(utime, FrameDecision::kRestart);
    return FrameDecision::kDiscard;
  }

  std::optional<int64_t> last() const { return last_; }

 private:
  static constexpr int64_t kNone = std::numeric_limits<int64_t>::max();

  FrameDecision accept(int64_t utime, FrameDecision decision) {
    last_ = utime;
    discarded_ = kNone;
    in_a_row_ = 0;
    return decision;
  }

  std::optional<int64_t> last_;
  /// The last one left out since a frame was accepted.
  int64_t discarded_ = kNone;
  int in_a_row_ = 0;
};

}  // namespace redbee
