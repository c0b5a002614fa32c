// Frame times of messages.
#pragma once

#include "redbee/geometry/time.hpp"

namespace redbee {

/// Time of the frame that the message is about.
template <typename Message>
CameraTime timeOf(const Message& message) {
  return CameraTime(fromUtime(message.utime));
}
/// Time of the frame that its homography starts from.
template <typename Message>
CameraTime previousTimeOf(const Message& message) {
  return CameraTime(fromUtime(message.utime_previous));
}

}  // namespace redbee
