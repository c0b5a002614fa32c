#include "redbee/importers/imu_table.hpp"

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/gcsv.hpp"
#include "redbee/importers/imu_csv.hpp"
#include "redbee/importers/phone_tables.hpp"
#include "redbee/importers/vector_table.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// Empty where there is none.
std::vector<std::string> headerOf(const fs::path& file) {
  CsvReader csv(file);
  csv.skipHeader();
  return csv.header();
}

/// The file of a folder that says what the folder is.
fs::path fileOf(const fs::path& folder) {
  for (const char* name : {"Gyroscope.csv", "gyro_accel.csv"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (isOpenCamera(entry.path()) || entry.path().extension() == ".gcsv") found.push_back(entry.path());
  }
  if (found.size() == 1) return found.front();
  throw InputError(folder,
                   "is no IMU recording that is known (Gyroscope.csv, gyro_accel.csv, one *gyro.csv or one "
                   "*.gcsv)");
}

void convertUnits(const ImuUnits& units, ImuTable& table) {
  const double gyro = factorOf(gyroUnits(), units.gyro, "--gyro-unit");
  const double accel = factorOf(accelUnits(), units.accel, "--accel-unit");
  for (ImuSample& sample : table.samples) {
    sample.gyro *= gyro;
    sample.accel *= accel;
  }
  table.units.gyro = units.gyro;
  table.units.accel = units.accel;
}

}  // namespace

ImuTable readImuTable(const fs::path& source, const fs::path& video, const ImuUnits& units) {
  const fs::path file = fs::is_directory(source) ? fileOf(source) : source;
  if (isGcsv(file)) return readGcsv(file, units);
  const std::vector<std::string> header = headerOf(file);
  ImuTable table;
  if (hasColumn(header, "seconds_elapsed") && !hasColumn(header, "gx")) {
    table = readSensorLoggerFolder(file.parent_path(), video);
  } else if (hasColumn(header, "Timestamp[nanosec]")) {
    table = readMars(file);
  } else if (header.empty() && isOpenCamera(file)) {
    table = readOpenCameraFiles(file);
  } else {
    return readImuCsv(file, units);
  }
  convertUnits(units, table);
  return table;
}

}  // namespace redbee
