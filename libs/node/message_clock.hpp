// The current time of a node, from the times in messages; no system clock is used.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// The newest frame's time, plus how far another sensor's times have advanced since that frame arrived. Only
/// steps of the sensor's clock count, never its reading: a clock that is off by half a second, or by hours,
/// makes no wait time out. Frames are trusted (FrameQueue has checked them).
class MessageClock {
 public:
  /// A sensor's time that differs by more from the one before is damaged, or its clock was set: no time has
  /// passed.
  static constexpr Duration kMaxStep = std::chrono::milliseconds(250);

  void noteFrame(CameraTime time) {
    if (frame_ && time <= *frame_) return;
    frame_ = time;
    since_frame_ = Duration(0);
  }
  void noteOther(ImuTime reading) {
    if (other_ && isStep(*other_, reading)) {
      since_frame_ += std::max(reading - *other_, Duration(0));
      other_ = std::max(*other_, reading);
    } else {
      other_ = reading;
    }
  }
  /// To be called when the clock was set back.
  void restart() { *this = {}; }
  /// Time 0 before the first frame.
  CameraTime now() const { return frame_ ? *frame_ + since_frame_ : CameraTime(); }

 private:
  /// As doubles, so that differences cannot overflow.
  static bool isStep(ImuTime from, ImuTime to) {
    return std::abs(static_cast<double>(toUtime(to)) - static_cast<double>(toUtime(from))) <=
           static_cast<double>(kMaxStep.count());
  }

  std::optional<CameraTime> frame_;
  Duration since_frame_{};
  std::optional<ImuTime> other_;
};

}  // namespace redbee
