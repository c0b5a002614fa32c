// Publishes a detector's output as FOREGROUND, DETECTIONS and OVERLAY, on the raw image's grid.
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

  /// `image`: as received. `output`: on the ideal grid, of an image from which `exposure` was taken out.
  /// Publishes one message of each kind, and periodically an overlay.
  void publish(const image_t& image, CameraTime time_previous, DetectorOutput output,
               const Exposure& exposure = {});
  /// From the next frame on.
  void drawOverlays(bool wanted) { draws_overlays_ = wanted; }

 private:
  void publishOverlay(const image_t& image, const DetectorOutput& output);

  Publisher& publisher_;
  const Configuration& configuration_;
  const RectifiedCamera& camera_;
  int frames_since_overlay_ = 0;
  bool draws_overlays_ = true;
};

}  // namespace redbee
