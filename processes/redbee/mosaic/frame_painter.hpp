// Frames of a flight onto the mosaic, without what moves: of a log, and live.
#pragma once

#include <cstdint>
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
  Exposure exposure{};
};

class FramePainter {
 public:
  /// `own_parts`: see Rectifier.
  FramePainter(const CameraIntrinsics& camera, const cv::Mat1b& own_parts) : camera_(camera, 1, own_parts) {}

  const Camera& camera() const { return camera_.camera(); }
  cv::Size idealSize() const { return {camera().ideal().width, camera().ideal().height}; }

  /// `to_map`: from the frame's ideal pixels. Without a mask nothing says what moves, and nothing is painted.
  /// Returns whether the frame was: not one that is damaged, or of another camera.
  bool paint(const image_t& image, const ObservedFrame& frame, const Eigen::Matrix3d& to_map, Mosaic& mosaic);

 private:
  cv::Mat1b leftOut(const ObservedFrame& frame, const Exposure& exposure) const;

  RectifiedCamera camera_;
  HealthMonitor health_{"redbee-mosaic", ""};
};

}  // namespace redbee
