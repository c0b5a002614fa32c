// Frames of a flight onto the mosaic, without what moves: of a log, and live.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "processes/rectified_camera.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/mosaic/mosaic.hpp"

namespace redbee {

/// What is known of a frame beside its image.
struct ObservedFrame {
  const std::vector<uint8_t>* mask =
      nullptr;                               ///< PNG on the raw image's grid, 255 moving; null: no valid one
  const detections_t* detections = nullptr;  ///< null: none
  std::optional<RowMotion> row_motion;       ///< of a rolling shutter's image
};

class FramePainter {
 public:
  explicit FramePainter(const CameraIntrinsics& camera) : camera_(camera) {}

  const Camera& camera() const { return camera_.camera(); }
  cv::Size idealSize() const { return {camera().ideal().width, camera().ideal().height}; }

  /// `to_map`: from the frame's ideal pixels. Without a mask nothing says what moves, and nothing is painted.
  /// Returns whether the frame was: not one that is damaged, or of another camera.
  bool paint(const image_t& image, const ObservedFrame& frame, const Eigen::Matrix3d& to_map, Mosaic& mosaic);

 private:
  cv::Mat1b leftOut(const ObservedFrame& frame, const std::optional<RowMotion>& row_motion) const;

  RectifiedCamera camera_;
  HealthMonitor health_{"redbee-mosaic", ""};
};

}  // namespace redbee
