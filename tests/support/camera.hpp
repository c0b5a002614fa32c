// The camera of all simulated flights.
#pragma once

#include "redbee/geometry/camera.hpp"

namespace redbee::test {

inline constexpr int kWidth = 640;   ///< px
inline constexpr int kHeight = 480;  ///< px

/// f = 500 px, principal point in the middle, no distortion.
inline CameraIntrinsics intrinsics() { return {kWidth, kHeight, 500, 500, 319.5, 239.5, {}}; }
inline Camera camera() { return Camera(intrinsics()); }

/// The same view with a quarter of the pixels, for faster tests.
inline CameraIntrinsics halved(CameraIntrinsics half) {
  half.width /= 2;
  half.height /= 2;
  half.fx /= 2;
  half.fy /= 2;
  half.cx = (half.cx - 0.5) / 2;
  half.cy = (half.cy - 0.5) / 2;
  return half;
}

}  // namespace redbee::test
