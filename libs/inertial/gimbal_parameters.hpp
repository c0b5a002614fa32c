// What a vehicle file says of a camera that turns against the IMU: the section `gimbal`.
#pragma once

#include "redbee/geometry/angle.hpp"

namespace redbee {

struct GimbalParameters {
  /// True: GIMBAL says how the mount is turned against the IMU's body, and camera.R_CI how the camera sits on
  /// the mount: at rest they are the same. False: the camera is fixed to the IMU.
  bool enabled = false;
  double angle_sigma_deg = 0.1;  ///< deg, one standard deviation about each axis, anew in each frame
  double timeshift_s = 0;        ///< s, the gimbal was where it says at its message's time + timeshift
  double max_gap_s = 0.25;       ///< s between two messages: in a longer gap the mount is not known

  /// rad^2
  double angleVariance() const { return angle_sigma_deg * kDegree * angle_sigma_deg * kDegree; }
};

}  // namespace redbee
