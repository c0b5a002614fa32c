// What a flight says of the ground and of what moves on it: homographies, planes, masks, detections.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/mosaic/ground_chain.hpp"

namespace redbee {

class GroundObserver {
 public:
  /// The messages must be plausible.
  void onFused(const fused_homography_t& fused);
  void onForeground(const foreground_t& foreground);
  void onDetections(const detections_t& detections) { detections_[detections.utime] = detections; }

  void onDamaged() { ++damaged_; }

  const GroundChain& chain() const { return chain_; }
  /// PNG on the raw image's grid, 255 moving, of the frame at this time; null where there is no valid one.
  const std::vector<uint8_t>* mask(int64_t utime) const;
  /// Null where there are none.
  const detections_t* detections(int64_t utime) const;
  /// Of the image at this time.
  Exposure exposure(int64_t utime) const;
  const std::map<int64_t, detections_t>& detections() const { return detections_; }
  /// Messages that cannot be decoded or are implausible.
  int64_t damaged() const { return damaged_; }

 private:
  GroundChain chain_;
  std::map<int64_t, std::vector<uint8_t>> masks_;
  std::map<int64_t, detections_t> detections_;
  int64_t damaged_ = 0;
  std::map<int64_t, Exposure> exposures_;
};

/// From the log's own FUSED_HOMOGRAPHY, FOREGROUND and DETECTIONS; where it has none, from those of the stack
/// over its camera, IMU and altimeter. Throws InputError if the log holds no image.
GroundObserver observeGround(const std::filesystem::path& log, const Configuration& configuration);

}  // namespace redbee
