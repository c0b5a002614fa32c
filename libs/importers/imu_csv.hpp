// A table of IMU samples, as spreadsheets, phones and loggers write it.
#pragma once

#include <filesystem>

#include "redbee/importers/imu_table.hpp"
#include "redbee/importers/imu_units.hpp"

namespace redbee {

/// The first line, which may be a comment, names the columns, in any order: t_s [s, on the video's clock], gx
/// gy gz [rad/s], ax ay az [m/s^2, specific force], or in `units`. Other columns are ignored. For separators
/// see CsvReader, for times RowTimes. Throws InputError with file and line.
ImuTable readImuCsv(const std::filesystem::path& file, const ImuUnits& units = {});

}  // namespace redbee
