// Time shift and R_CI from the rotations of camera and gyro, without initial values.
//
// 1. The magnitudes of the two angular rates are correlated over the time shift; this needs no R_CI.
// 2. R_CI and gyro bias follow in closed form (hand_eye.hpp). A homography admits two rotations; the one that
//    agrees with the gyro under the current R_CI is selected and R_CI is estimated again, from several
//    initial values.
// 3. The time shift with the smallest residual of step 2, refined by a parabola through the curve's minimum.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "redbee/calibration/hand_eye.hpp"
#include "redbee/calibration/homography_rotation.hpp"
#include "redbee/calibration/imu_history.hpp"

namespace redbee::calibration {

/// The camera's rotation between two exposures. Times are on the camera's clock, seconds since the common
/// origin.
struct RotationObservation {
  double t_a_s;
  double t_b_s;
  RotationCandidates rotation;
};

struct TimeShiftCurve {
  std::vector<double> shift_s;
  std::vector<double> value;
};

struct RotationAlignment {
  bool possible =
      false;  ///< enough observations are covered by the IMU; otherwise the other members are not valid
  double timeshift_s = 0;            ///< t_imu = t_cam + timeshift
  double correlation = 0;            ///< of the rates' magnitudes at their best shift, -1..1
  double rate_variation = 0;         ///< rad/s: standard deviation of the camera's rate, its signal
  HandEye hand_eye;                  ///< at timeshift_s
  TimeShiftCurve correlation_curve;  ///< correlation of magnitudes
  TimeShiftCurve residual_curve;     ///< residual of the closed form [rad/s]
  std::vector<double> t_s;           ///< camera clock, middle of each interval used
  std::vector<RatePair> rates;       ///< of these intervals, at timeshift_s
};

struct RotationAlignmentOptions {
  double max_shift_s = 0.1;
  double max_interval_s = 0.3;  ///< longer intervals are left out
};

RotationAlignment alignRotations(const std::vector<RotationObservation>& observations, const ImuHistory& imu,
                                 const RotationAlignmentOptions& options = {});

}  // namespace redbee::calibration
