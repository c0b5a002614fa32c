// IMU recordings beside a video, as phones and loggers write them; recognised by their headers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "redbee/importers/imu_units.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct ImuTable {
  std::vector<ImuSample> samples;  ///< times on the video's clock, as far as the recording tells it
  ImuUnits units;                  ///< in which it was read, for advice
  std::vector<std::string> warnings;
};

/// `source`: a file, or the folder that the app left.
///
/// - Sensor Logger: Gyroscope.csv; TotalAcceleration.csv, or Accelerometer.csv and Gravity.csv; Metadata.csv.
///   Clock: that of the app's own video (Camera/<ms>.mp4), otherwise the start of the recording.
/// - MARS Logger: gyro_accel.csv; frame_timestamps.txt or movie_metadata.csv. Clock: of the frames.
/// - OpenCamera Sensors: NAME_gyro.csv, NAME_accel.csv and NAME_timestamps.csv, or NAMEgyro.csv,
/// NAMEaccel.csv
///   and NAME_imu_timestamps.csv. Clock: of the frames.
/// - Gyroflow's loggers: F.gcsv. Clock: of the video.
/// - Anything else: readImuCsv(). Clock: of the video.
///
/// Gyro and accelerometer of separate files are joined at the gyro's times. Specific force is positive upward
/// at rest: an iPhone's signs are turned. Throws InputError with file and line.
ImuTable readImuTable(const std::filesystem::path& source, const std::filesystem::path& video,
                      const ImuUnits& units);

}  // namespace redbee
