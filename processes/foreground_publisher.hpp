// What a detector found in a frame, as FOREGROUND, DETECTIONS and OVERLAY on the raw image's grid.
#pragma once

#include <cstdint>

#include "processes/rectified_camera.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/detector.hpp"
#include "redbee/image_t.hpp"
#include "redbee/node/publisher.hpp"

namespace redbee {

class ForegroundPublisher {
 public:
  ForegroundPublisher(Publisher& publisher, const Configuration& configuration, const RectifiedCamera& camera)
      : publisher_(publisher), configuration_(configuration), camera_(camera) {}

  /// `image`: the frame as it came. `output`: on the ideal grid. One message of each kind, and an overlay
  /// every so often.
  void publish(const image_t& image, int64_t utime_previous, DetectorOutput output);

 private:
  void publishOverlay(const image_t& image, const DetectorOutput& output);

  Publisher& publisher_;
  const Configuration& configuration_;
  const RectifiedCamera& camera_;
  int frames_since_overlay_ = 0;
};

}  // namespace redbee
