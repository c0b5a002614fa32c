// Reads the calibration's input from a recorded flight.
#pragma once

#include <filesystem>

#include "redbee/calibration/calibration.hpp"
#include "redbee/configuration/configuration.hpp"

namespace redbee {

/// Reads IMU, altimeter and images, and tracks points from each image to the next; fills imu, altimeter,
/// frames and ground of `input`. Damaged messages and events are skipped with a warning. Throws InputError if
/// the log holds no images or no IMU, or images of another size than configured.
void readCalibrationLog(const std::filesystem::path& log, const Configuration& configuration, bool quiet,
                        calibration::CalibrationInput& input);

}  // namespace redbee
