// Puts the messages about a frame together: image, mask, detections, trails.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "processes/serve/frame_view.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"

namespace redbee {

/// A frame is whole when its detections are there; the image and the mask were published before them. Where
/// no detections come, images are shown without.
class FrameAssembly {
 public:
  explicit FrameAssembly(const Configuration& configuration);

  void onFused(const fused_homography_t& fused);
  void onImage(image_t image);
  void onForeground(foreground_t foreground);
  void onDetections(detections_t detections);

  /// Nobody looks: images and masks are neither received nor kept.
  void dropImages();

  /// The newest frame to show, once each; std::nullopt if there is none since.
  std::optional<FrameView> takeFrame();

 private:
  void showWithoutDetections(const std::shared_ptr<const image_t>& image);
  std::string cameraFault(const image_t& image) const;

  int width_;
  int height_;
  Trails trails_;
  std::deque<std::shared_ptr<const image_t>> images_;  ///< newest last
  std::deque<foreground_t> masks_;
  int64_t detections_utime_ = 0;
  std::string source_;
  std::optional<FrameView> ready_;
};

}  // namespace redbee
