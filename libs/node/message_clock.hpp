// The passing of time as a node sees it: by the times in messages, never by a clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace redbee {

/// The latest time in any message. Frames are trusted (FrameOrder has classified them); any other sensor's
/// time only while it lies near theirs, so that a damaged time, or a clock that is off by hours,
/// does not end every wait from then on.
class MessageClock {
 public:
  /// us: how far another sensor may be from the frames.
  static constexpr int64_t kNear = 2'000'000;

  void noteFrame(int64_t utime) {
    frame_ = frame_ ? std::max(*frame_, utime) : utime;
    if (other_ && !isNear(*other_)) other_.reset();
  }
  void noteOther(int64_t utime) {
    if (isNear(utime)) other_ = other_ ? std::max(*other_, utime) : utime;
  }
  /// Time was set back: forgets all times.
  void restart() { *this = {}; }
  /// us; 0 before the first frame.
  int64_t now() const { return std::max(frame_.value_or(0), other_.value_or(frame_.value_or(0))); }

 private:
  bool isNear(int64_t utime) const {
    return frame_ && std::abs(static_cast<double>(utime) - static_cast<double>(*frame_)) <= kNear;
  }

  std::optional<int64_t> frame_;
  std::optional<int64_t> other_;
};

}  // namespace redbee
