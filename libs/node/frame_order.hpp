// Classifies frames by the order of their times; the same rule in all nodes.
#pragma once

#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

enum class FrameDecision { kNext, kDiscard, kRestart };

/// A frame that is not newer than the last one is late or a duplicate and is discarded, unless the clock was
/// set back: after `kRestartAfter` such frames in a row, each newer than the one before, they are accepted.
class FrameOrder {
 public:
  static constexpr int kRestartAfter = 5;
  /// A frame this much older than the last one is a clock that was set back.
  static constexpr Duration kSetBack = std::chrono::seconds(2);

  FrameDecision classify(CameraTime time) {
    if (!last_ || time > *last_) return accept(time, FrameDecision::kNext);
    in_a_row_ = time > discarded_ ? in_a_row_ + 1 : 1;
    discarded_ = time;
    if (in_a_row_ >= kRestartAfter || *last_ - time > kSetBack) return accept(time, FrameDecision::kRestart);
    return FrameDecision::kDiscard;
  }

  std::optional<CameraTime> last() const { return last_; }

 private:
  static constexpr CameraTime kNone = CameraTime::max();

  FrameDecision accept(CameraTime time, FrameDecision decision) {
    last_ = time;
    discarded_ = kNone;
    in_a_row_ = 0;
    return decision;
  }

  std::optional<CameraTime> last_;
  /// The last frame discarded since one was accepted.
  CameraTime discarded_ = kNone;
  int in_a_row_ = 0;
};

}  // namespace redbee
