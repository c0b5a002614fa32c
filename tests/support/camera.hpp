// The camera of all simulated flights.
#pragma once

#include "redbee/geometry/camera.hpp"

namespace redbee::test {

inline constexpr int kWidth = 640;   ///< px
inline constexpr int kHeight = 480;  ///< px

/// f = 500 px, principal point in the middle, no distortion.
inline CameraIntrinsics intrinsics() { return {kWidth, kHeight, 500, 500, 319.5, 239.5, {}}; }
inline Camera camera() { return Camera(intrinsics()); }

/// The same view in a quarter of the pixels, for flights that need to be cheap and no detail.
inline CameraIntrinsics halved(const CameraIntrinsics& full) {
  return {full.width / 2,      full.height / 2,     full.fx / 2,    full.fy / 2,
          (full.cx - 0.5) / 2, (full.cy - 0.5) / 2, full.distortion};
}

}  // namespace redbee::test
