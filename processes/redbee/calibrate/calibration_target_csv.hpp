// Recordings of a calibration target as CSV files.
#pragma once

#include <filesystem>
#include <vector>

#include "redbee/calibration/calibration.hpp"

namespace redbee {

/// Columns: ts [ns], tag rows, tag columns, tag size [m], tag spacing, pixel x, y [px, raw], target point x,
/// y, z [m], tag id, corner. Rows of one image share ts and stand together, times increasing. A name that
/// ends in .gz is unpacked. Throws InputError with file and line.
std::vector<calibration::TargetView> readTargetCorners(const std::filesystem::path& csv);

/// Columns: ts [ns], gyro x, y, z [rad/s], accelerometer x, y, z [m/s^2]. Throws InputError with file and
/// line.
std::vector<ImuSample> readTargetImu(const std::filesystem::path& csv);

}  // namespace redbee
