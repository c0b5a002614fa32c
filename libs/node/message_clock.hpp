// The current time of a node, from the times in messages; no system clock is used.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// The latest time in any message. Frames are trusted (FrameQueue has checked them); times of other sensors
/// are used only if they are close to the frames', so that a damaged time, or a clock that is off by hours,
/// does not make every later wait time out.
class MessageClock {
 public:
  /// Largest difference between another sensor's time and the frames'.
  static constexpr Duration kNear = std::chrono::seconds(2);

  void noteFrame(CameraTime time) {
    frame_ = frame_ ? std::max(*frame_, time) : time;
    if (other_ && !isNear(*other_)) other_.reset();
  }
  /// The time shift is a few milliseconds and is neglected here.
  void noteOther(ImuTime reading) {
    const CameraTime time = toCamera(reading, Duration(0));
    if (isNear(time)) other_ = other_ ? std::max(*other_, time) : time;
  }
  /// To be called when the clock was set back.
  void restart() { *this = {}; }
  /// Time 0 before the first frame.
  CameraTime now() const {
    const CameraTime frame = frame_.value_or(CameraTime());
    return std::max(frame, other_.value_or(frame));
  }

 private:
  bool isNear(CameraTime time) const {
    return frame_ &&
           std::abs(microseconds(time) - microseconds(*frame_)) <= static_cast<double>(kNear.count());
  }

  /// As a double, so that differences cannot overflow.
  static double microseconds(CameraTime time) { return static_cast<double>(toUtime(time)); }

  std::optional<CameraTime> frame_;
  std::optional<CameraTime> other_;
};

}  // namespace redbee
