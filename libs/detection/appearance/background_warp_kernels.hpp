// Resampling of a run of pixels of the background model, as vector code.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// Pixels of a run at most.
inline constexpr int kWarpRun = 16;

struct WarpedMaps {
  int width, height;
  const float* model;  ///< four channels
  const float* speed;
  const uint8_t* age;
};

struct WarpRun {
  float x, y;            ///< px, where the first pixel comes from
  float step_x, step_y;  ///< from pixel to pixel
  int pixels;
  float* model;
  float* speed;
  uint8_t* age;
};

/// The model is interpolated linearly, speed and age are the nearest pixel's; all are 0 outside of the maps.
void warpRun(const WarpedMaps& maps, const WarpRun& run);

}  // namespace redbee
