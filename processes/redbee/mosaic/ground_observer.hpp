// What a flight says of the ground and of what moves on it: homographies, planes, masks, detections.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "processes/redbee/mosaic/frame_painter.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/mosaic/ground_chain.hpp"

namespace redbee {

/// Of the images, by their times [us].
using Exposures = std::map<int64_t, Exposure>;
/// As the camera is configured where nothing is known.
Exposure exposureAt(const Exposures& exposures, int64_t utime);

/// The image's exposure; the step of the ground's homography and its plane, if it has them. Precondition: the
/// message is plausible.
void note(const fused_homography_t& fused, Exposures& exposures, GroundChain& chain);

class GroundObserver {
 public:
  /// The messages must be plausible.
  void onFused(const fused_homography_t& fused);
  void onForeground(const foreground_t& foreground);
  void onDetections(const detections_t& detections) { detections_[detections.utime] = detections; }

  void onDamaged() { ++damaged_; }

  const GroundChain& chain() const { return chain_; }
  /// At this time.
  ObservedFrame frame(int64_t utime) const;
  /// Messages that cannot be decoded or are implausible.
  int64_t damaged() const { return damaged_; }

 private:
  GroundChain chain_;
  std::map<int64_t, std::vector<uint8_t>> masks_;
  std::map<int64_t, detections_t> detections_;
  int64_t damaged_ = 0;
  Exposures exposures_;
};

/// From the log's own FUSED_HOMOGRAPHY, FOREGROUND and DETECTIONS; where it has none, from those of the stack
/// over its camera, IMU and altimeter. Throws InputError if the log holds no image.
GroundObserver observeGround(const std::filesystem::path& log, const Configuration& configuration);

}  // namespace redbee
