// The IMU recordings of phones' apps, each a folder of tables. For what they are made of see readImuTable().
#pragma once

#include <filesystem>

#include "redbee/importers/imu_table.hpp"

namespace redbee {

/// The video's name tells its start, where the app recorded it. Throws InputError, as the others do.
ImuTable readSensorLoggerFolder(const std::filesystem::path& folder, const std::filesystem::path& video);
/// `file`: gyro_accel.csv.
ImuTable readMars(const std::filesystem::path& file);
/// By its name and that of the accelerometer's table beside it. Those have no header.
bool isOpenCamera(const std::filesystem::path& file);
ImuTable readOpenCameraFiles(const std::filesystem::path& gyro_file);

}  // namespace redbee
