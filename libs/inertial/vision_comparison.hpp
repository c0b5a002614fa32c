// The rotations of vision beside the IMU's: whether they agree, and the time shift that they show.
#pragma once

#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/homography_measurement.hpp"
#include "redbee/inertial/rotation_difference.hpp"
#include "redbee/inertial/timeshift_monitor.hpp"
#include "redbee/inertial/vision_agreement.hpp"

namespace redbee {

struct VisionComparison {
  explicit VisionComparison(const InertialExtrinsics& extrinsics) : timeshift(extrinsics) {}

  /// Vision's homography [ideal pixels; covariance scaled] between the filter's clone at a and its pose at b.
  void note(const NavigationState& state, const Camera& camera, const Eigen::Vector3d& p_IC, CameraTime a,
            CameraTime b, const Eigen::Matrix3d& H, const Matrix8d& covariance) {
    const auto difference = rotationDifference(state, camera, p_IC, H, covariance);
    if (!difference) return;
    const Eigen::Matrix3d R_ba = cameraMotion(state, p_IC).R_ba;
    agreement.note({a, b, R_ba, *difference});
    timeshift.addVision(a, b, expSO3(difference->difference) * R_ba);
  }

  VisionAgreement agreement;
  TimeshiftMonitor timeshift;
};

}  // namespace redbee
