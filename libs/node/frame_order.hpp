// The order of frames in time: one rule for all nodes, so that they agree.
#pragma once

#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

enum class FrameDecision { kNext, kDiscard, kRestart };

/// A frame that is not newer than the last one came late or twice and is left out, unless time itself was set
/// back: then the frames go on from an earlier time, and after `kRestartAfter` of them in a row, each newer
/// than the one before, they are accepted.
class FrameOrder {
 public:
  static constexpr int kRestartAfter = 5;
  /// A frame this far in the past is a clock that was set back, at once.
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
  /// The last one left out since a frame was accepted.
  CameraTime discarded_ = kNone;
  int in_a_row_ = 0;
};

}  // namespace redbee
