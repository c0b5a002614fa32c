// From a recorded flight to the calibration's input.
#pragma once

#include <filesystem>

#include "redbee/calibration/calibration.hpp"
#include "redbee/configuration/configuration.hpp"

namespace redbee {

/// Reads IMU, altimeter and images, and follows points from each image to the next; fills imu, altimeter,
/// frames and ground of `input`. Damaged messages and events are skipped with a warning. Throws InputError if
/// the log holds no images or no IMU, or images of another size than configured.
void readCalibrationLog(const std::filesystem::path& log, const Configuration& configuration, bool quiet,
                        calibration::CalibrationInput& input);

}  // namespace redbee
