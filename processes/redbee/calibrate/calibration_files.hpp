// The files that `redbee calibrate` writes, except for its report.
#pragma once

#include <string>

#include "redbee/calibration/calibration.hpp"

namespace redbee {

/// The calibrated vehicle and the recording.
struct CalibrationSubject {
  std::string vehicle;
  std::string source;  ///< the recording
};

/// Kalibr's camchain-imucam.yaml: T_cam_imu and timeshift_cam_imu; the inverse transform in comments.
std::string kalibrCamchain(const calibration::CalibrationInput& input,
                           const calibration::CalibrationResult& result, const CalibrationSubject& subject);
/// Kalibr's imu.yaml; the estimated biases in comments.
std::string kalibrImu(const calibration::CalibrationInput& input,
                      const calibration::CalibrationResult& result, const CalibrationSubject& subject);
/// The keys of a vehicle's configuration that were estimated, to be included after the vehicle's own file.
/// Refused parameters are left out.
std::string onlineCalibration(const calibration::CalibrationInput& input,
                              const calibration::CalibrationResult& result,
                              const CalibrationSubject& subject);
/// Values, standard deviations and verdicts as JSON.
std::string verdictJson(const calibration::CalibrationResult& result, const CalibrationSubject& subject);

}  // namespace redbee
