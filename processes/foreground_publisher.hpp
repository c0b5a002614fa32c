// What a detector says of a frame, as FOREGROUND, DETECTIONS and OVERLAY on the raw image's grid.
#pragma once

#include <cstdint>

#include "processes/rectified_camera.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/detector.hpp"
#include "redbee/image_t.hpp"

namespace redbee {

class ForegroundPublisher {
 public:
  ForegroundPublisher(Bus& bus, const Configuration& configuration, const RectifiedCamera& camera)
      : bus_(bus), configuration_(configuration), camera_(camera) {}

  /// `image`: the frame as it came. `output`: on the ideal grid. One message of each kind, and an overlay
  /// every so often.
  void publish(const image_t& image, int64_t utime_previous, DetectorOutput output);

 private:
  void publishOverlay(const image_t& image, const DetectorOutput& output);

  Bus& bus_;
  const Configuration& configuration_;
  const RectifiedCamera& camera_;
  int32_t sequence_ = 0;
  int frames_since_overlay_ = 0;
};

}  // namespace redbee
