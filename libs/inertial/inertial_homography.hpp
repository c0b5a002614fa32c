// The inertial filter's estimate of the motion between two frames.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/lens_track.hpp"

namespace redbee {

enum class InertialStatus {
  kGood,          ///< the whole interval is covered by IMU samples
  kInitialising,  ///< first frame, or first after a gap: no homography yet
  kImuGap,        ///< samples are missing in the interval: bridged, with a larger covariance
  kNoImu,         ///< no samples in the interval: no homography
  kClockJump,     ///< time ran backwards or jumped: restarted, no homography
  kBadSamples,    ///< samples in the interval were refused (ImuSampleCheck) and not used
  kDisagreement,  ///< vision contradicts the IMU (VisionAgreement): left out, no homography
  kNoMount,       ///< the gimbal did not say how the camera's mount was turned at both frames: no homography
  kUncertain,     ///< the motion since the last frame is not known to any use: no homography
};
const char* toString(InertialStatus status);

/// Motion of the camera from the previous frame a to frame b, and the resulting ground homography.
struct InertialHomography {
  CameraTime time_previous{};
  CameraTime time{};
  InertialStatus status = InertialStatus::kInitialising;
  bool valid = false;                               ///< H, covariance and motion are valid
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();  ///< ideal pixels of a to ideal pixels of b, h33 = 1
  Matrix8d covariance = Matrix8d::Zero();  ///< of the scaled homography's eight entries (homography.hpp)
  /// R_ba, t_ba, m_a, h_a in camera frames [m].
  PlaneMotion motion{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 1.0};
  Eigen::Matrix3d rotation_covariance = Eigen::Matrix3d::Zero();   ///< of R_ba, left perturbation [rad^2]
  Eigen::Vector3d direction_of_gravity = Eigen::Vector3d::Zero();  ///< unit, down, in camera frame b
  double height_m = 0;                                             ///< of camera b above the ground plane
  double height_sigma_m = 0;
  /// During the read-out of frame b, whether `valid` or not; std::nullopt for a global shutter, without IMU
  /// samples, and while vision contradicts the IMU.
  std::optional<RowMotion> row_motion;
  Zoom zoom;  ///< of frame b, whether `valid` or not
};

}  // namespace redbee
