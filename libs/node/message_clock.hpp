// The passing of time as a node sees it: by the times in messages, never by a clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// The latest time in any message. Frames are trusted (FrameOrder has classified them); any other sensor's
/// time only while it lies near theirs, so that a damaged time, or a clock that is off by hours,
/// does not end every wait from then on.
class MessageClock {
 public:
  /// How far another sensor may be from the frames.
  static constexpr Duration kNear = std::chrono::seconds(2);

  void noteFrame(CameraTime time) {
    frame_ = frame_ ? std::max(*frame_, time) : time;
    if (other_ && !isNear(*other_)) other_.reset();
  }
  /// The time shift is milliseconds and does not matter here.
  void noteOther(ImuTime reading) {
    const CameraTime time = toCamera(reading, Duration(0));
    if (isNear(time)) other_ = other_ ? std::max(*other_, time) : time;
  }
  /// Time was set back: forgets all times.
  void restart() { *this = {}; }
  /// The clock's beginning before the first frame.
  CameraTime now() const {
    const CameraTime frame = frame_.value_or(CameraTime());
    return std::max(frame, other_.value_or(frame));
  }

 private:
  bool isNear(CameraTime time) const {
    return frame_ &&
           std::abs(microseconds(time) - microseconds(*frame_)) <= static_cast<double>(kNear.count());
  }

  /// As a number whose differences cannot overflow.
  static double microseconds(CameraTime time) { return static_cast<double>(toUtime(time)); }

  std::optional<CameraTime> frame_;
  std::optional<CameraTime> other_;
};

}  // namespace redbee
