// Gyroflow's .gcsv (docs.gyroflow.xyz/app/technical-details/gcsv-format).
#pragma once

#include <filesystem>

#include "redbee/importers/imu_table.hpp"

namespace redbee {

/// True for a file that begins like one.
bool isGcsv(const std::filesystem::path& file);

/// Times, scales and orientation as the file states them; the orientation's axes are the samples'. `units`:
/// of the gyro, what its scale gives; the accelerometer's is told by gravity. Throws InputError with file and
/// line.
ImuTable readGcsv(const std::filesystem::path& file, const ImuUnits& units = {});

}  // namespace redbee
