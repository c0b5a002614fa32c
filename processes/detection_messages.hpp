// Between detection_t and the library's Detection.
#pragma once

#include <Eigen/Core>

#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/detection_t.hpp"

namespace redbee {

inline detection_t messageOf(const Detection& detection) {
  detection_t message{};
  message.id = detection.id;
  message.x = detection.box.x;
  message.y = detection.box.y;
  message.width = detection.box.width;
  message.height = detection.box.height;
  message.area = detection.area_px;
  message.score = detection.score;
  message.seen = detection.seen ? 1 : 0;
  return message;
}

inline Detection detectionOf(const detection_t& message) {
  Detection detection;
  detection.id = message.id;
  detection.box = {message.x, message.y, message.width, message.height};
  detection.area_px = message.area;
  detection.score = message.score;
  detection.seen = message.seen != 0;
  return detection;
}

/// The middle of the box's lower edge, where an object seen from the side stands [px].
inline Eigen::Vector2d lowerMiddle(const detection_t& message) {
  return {message.x + 0.5 * (message.width - 1), message.y + message.height - 1.0};
}

}  // namespace redbee
