// Whether the calibration fits the flight, as every node that sees both homographies says it in its health.
#pragma once

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/inertial/calibration_monitor.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// One frame: the ground's homography as the IMU predicted it and as vision measured it, between pixels of
/// the camera `ideal`, and the test ratio of their difference.
inline void noteCalibration(CalibrationMonitor& monitor, HealthMonitor& health, double test_ratio,
                            const Eigen::Matrix3d& predicted, const Eigen::Matrix3d& measured,
                            const CameraIntrinsics& ideal) {
  monitor.note(test_ratio, meanTransferError(predicted, measured, ideal.width, ideal.height));
  health.setCalibration(monitor.verdict());
}

}  // namespace redbee
