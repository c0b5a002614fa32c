// Times of frames in messages about them.
#pragma once

#include "redbee/geometry/time.hpp"

namespace redbee {

/// Of the frame that the message is about.
template <typename Message>
CameraTime timeOf(const Message& message) {
  return CameraTime(fromUtime(message.utime));
}
/// Of the frame that its homography starts from.
template <typename Message>
CameraTime previousTimeOf(const Message& message) {
  return CameraTime(fromUtime(message.utime_previous));
}

}  // namespace redbee
