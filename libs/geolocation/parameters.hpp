// Parameters of the geolocation: the section `geolocation` of the vehicle file.
#pragma once

#include <string>

namespace redbee {

struct GeolocationParameters {
  bool enabled = false;
  /// "body": the camera is fixed to the autopilot, turned as camera.R_CI says; "gimbal": GIMBAL says how its
  /// mount is turned, and camera.R_CI how the camera sits in it: the mount's axes are the body's at its rest.
  std::string mount = "body";
  double mount_sigma_deg = 0.5;       ///< deg, of the camera against the body or the mount, about each axis
  double pixel_sigma_px = 1.5;        ///< px, of an object's foot, anew in each frame
  double foot_sigma = 0.1;            ///< of the box's extent: the same, lasting about a second
  double height_over_length = 1;      ///< of an object: how much of its box is seen from the side
  double focal_sigma = 0.005;         ///< of the focal length
  double home_height_sigma_m = 2;     ///< m, of the height above ground where no altimeter measures it
  double ground_slope_sigma_deg = 1;  ///< deg, of the ground between camera and object
  double error_correlation_s = 30;    ///< s that errors of attitude, position and height last
  double acceleration_sigma = 1;      ///< m/s^2, of an object within a second
  double max_pose_age_s = 0.2;        ///< s that POSE and GIMBAL may be older than a frame
  double min_depression_deg = 5;      ///< deg below the horizon; a flatter ray is refused
  double keep_stopped_s = 60;         ///< s that who has stopped keeps its place without being seen
};

}  // namespace redbee
