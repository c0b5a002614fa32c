// Tables of one three-axis sensor each, joined to IMU samples.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "redbee/files/csv.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct AxisSample {
  int64_t time_ns = 0;
  Eigen::Vector3d value;
};

/// Where the columns are.
struct VectorColumns {
  size_t time = 0, x = 0, y = 0, z = 0;
};

bool hasColumn(const std::vector<std::string>& header, const std::string& name);

/// The place of a column by its name, blanks left out; fails with what is there.
size_t columnOf(const CsvReader& csv, const std::string& name);

/// A whole number that can be a time; fails otherwise.
int64_t timeOf(const CsvReader& csv, size_t column);

/// The rest of the table. Rows whose time leaps, or is not after the one before (apps repeat some), are left
/// out, and counted in `warnings`. Throws InputError with file and line, also for an empty table, and where
/// checkTimes() does.
std::vector<AxisSample> readVectors(CsvReader& csv, const VectorColumns& columns,
                                    std::vector<std::string>& warnings);

/// At the gyro's times, the accelerometer interpolated; gyro samples before its first or after its last are
/// left out. Time `origin_ns` becomes 0.
std::vector<ImuSample> joinAtGyroTimes(const std::vector<AxisSample>& gyro,
                                       const std::vector<AxisSample>& accel, int64_t origin_ns);

/// The first whole number of a table's first column, such as the first frame's time. Throws InputError.
int64_t firstInteger(const std::filesystem::path& file);

}  // namespace redbee
