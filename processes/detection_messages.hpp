// Between detection_t and the library's Detection.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

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

/// The `count` of the highest score, in their order.
inline std::vector<Detection> strongest(std::vector<Detection> detections, size_t count) {
  if (detections.size() <= count) return detections;
  std::vector<size_t> order(detections.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return detections[a].score > detections[b].score; });
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<Detection> result;
  result.reserve(count);
  for (const size_t i : order) result.push_back(detections[i]);
  return result;
}

/// The middle of the box's lower edge, where an object seen from the side stands [px].
inline Eigen::Vector2d lowerMiddle(const detection_t& message) {
  return {message.x + 0.5 * (message.width - 1), message.y + message.height - 1.0};
}

}  // namespace redbee
