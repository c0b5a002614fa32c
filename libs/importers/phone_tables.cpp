#include "redbee/importers/phone_tables.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/vector_table.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

using Warnings = std::vector<std::string>;

std::vector<ImuSample> requireSome(std::vector<ImuSample> samples, const fs::path& file) {
  if (samples.empty()) throw InputError(file, "has no time in common with the accelerometer");
  return samples;
}

bool nameEndsWith(const fs::path& file, const std::string& end) {
  const std::string name = file.filename().string();
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

// Sensor Logger.

std::vector<AxisSample> readSensorLogger(const fs::path& file, Warnings& warnings) {
  CsvReader csv(file);
  csv.skipHeader();
  return readVectors(csv, {columnOf(csv, "time"), columnOf(csv, "x"), columnOf(csv, "y"), columnOf(csv, "z")},
                     warnings);
}

/// With gravity, of an Android phone as it is, of an iPhone as the sum of two.
std::vector<AxisSample> sensorLoggersAccel(const fs::path& folder, Warnings& warnings) {
  if (fs::exists(folder / "TotalAcceleration.csv"))
    return readSensorLogger(folder / "TotalAcceleration.csv", warnings);
  if (!fs::exists(folder / "Accelerometer.csv") || !fs::exists(folder / "Gravity.csv")) {
    throw InputError(folder,
                     "holds neither TotalAcceleration.csv nor both Accelerometer.csv and Gravity.csv: record "
                     "the accelerometer with gravity");
  }
  const auto motion = readSensorLogger(folder / "Accelerometer.csv", warnings);
  const auto gravity = readSensorLogger(folder / "Gravity.csv", warnings);
  std::vector<AxisSample> sum;
  for (const ImuSample& sample : joinAtGyroTimes(motion, gravity, 0))
    sum.push_back({1000 * toUtime(sample.time), sample.gyro + sample.accel});
  if (sum.empty()) throw InputError(folder / "Gravity.csv", "has no time in common with Accelerometer.csv");
  return sum;
}

/// An iPhone counts against gravity's reaction, unless the app was told to standardise.
bool hasIphoneSigns(const fs::path& folder, Warnings& warnings) {
  const fs::path file = folder / "Metadata.csv";
  if (!fs::exists(file)) {
    warnings.push_back(folder.string() + ": no Metadata.csv: an Android phone's signs are assumed");
    return false;
  }
  CsvReader csv(file);
  csv.skipHeader();
  const size_t platform = columnOf(csv, "platform");
  const size_t standardisation =
      hasColumn(csv.header(), "standardisation") ? columnOf(csv, "standardisation") : platform;
  if (!csv.next(csv.columns())) throw InputError(file, "is empty");
  return csv.fields()[platform] == "ios" && csv.fields()[standardisation] != "true";
}

/// The app names its videos by their start, ms of the Unix clock.
std::optional<int64_t> startOfSensorLoggersVideo(const fs::path& video) {
  const std::string name = video.stem().string();
  constexpr size_t kDigits = 13;
  const bool is_time = name.size() == kDigits && std::all_of(name.begin(), name.end(), [](unsigned char c) {
                         return std::isdigit(c) != 0;
                       });
  if (!is_time) return std::nullopt;
  constexpr int64_t kLatest_ms = 4'000'000'000'000;
  const int64_t start_ms = std::stoll(name);
  if (start_ms > kLatest_ms) return std::nullopt;
  return int64_t{1'000'000} * start_ms;
}

/// When seconds_elapsed was 0.
int64_t startOfSensorLogger(const fs::path& file) {
  CsvReader csv(file);
  csv.skipHeader();
  const size_t time = columnOf(csv, "time"), elapsed = columnOf(csv, "seconds_elapsed");
  if (!csv.next(csv.columns())) throw InputError(file, "holds no samples");
  constexpr double kLongest_s = 1e7;
  const double elapsed_s = csv.number(elapsed);
  if (!(std::abs(elapsed_s) < kLongest_s)) csv.fail("'" + csv.fields()[elapsed] + "' s have not elapsed");
  return timeOf(csv, time) - static_cast<int64_t>(1e9 * elapsed_s);
}

// MARS Logger.

fs::path framesOfMars(const fs::path& folder) {
  for (const char* name : {"frame_timestamps.txt", "movie_metadata.csv"}) {
    if (fs::exists(folder / name)) return folder / name;
  }
  throw InputError(
      folder,
      "holds neither frame_timestamps.txt nor movie_metadata.csv: the IMU's clock counts from the "
      "phone's start, and only they give the first frame's time on it");
}

// OpenCamera Sensors.

fs::path besideGyro(const fs::path& gyro, const std::string& other) {
  std::string name = gyro.filename().string();
  name.replace(name.rfind("gyro.csv"), std::string::npos, other);
  return gyro.parent_path() / name;
}

/// Whose first number is the first frame's time. VID_1_gyro.csv has VID_1_timestamps.csv beside it, or, of
/// later versions of the app, VID_1gyro.csv has VID_1_imu_timestamps.csv.
fs::path framesOfOpenCamera(const fs::path& gyro) {
  std::string start = gyro.filename().string();
  start.erase(start.rfind("gyro.csv"));
  if (!start.empty() && start.back() != '_') start += '_';
  for (const char* end : {"imu_timestamps.csv", "timestamps.csv"}) {
    fs::path frames = gyro.parent_path() / (start + end);
    if (fs::exists(frames)) return frames;
  }
  throw InputError(gyro,
                   "has neither " + start + "imu_timestamps.csv nor " + start +
                       "timestamps.csv beside it: the IMU's clock counts from the phone's start, and only "
                       "they give the first frame's time on it");
}

std::vector<AxisSample> readOpenCamera(const fs::path& file, Warnings& warnings) {
  CsvReader csv(file);
  csv.skipHeader();
  if (!csv.header().empty()) csv.fail("has a header; OpenCamera Sensors writes none");
  return readVectors(csv, {3, 0, 1, 2}, warnings);
}

}  // namespace

ImuTable readSensorLoggerFolder(const fs::path& folder, const fs::path& video) {
  ImuTable table;
  const fs::path gyro_file = folder / "Gyroscope.csv";
  const auto gyro = readSensorLogger(gyro_file, table.warnings);
  const auto accel = sensorLoggersAccel(folder, table.warnings);
  const auto start = startOfSensorLoggersVideo(video);
  if (!start) {
    table.warnings.push_back(
        folder.string() +
        ": the video is taken to begin with the recording; redbee calibrate finds the rest, "
        "or record the video with the app (Camera/<ms>.mp4)");
  }
  table.samples =
      requireSome(joinAtGyroTimes(gyro, accel, start ? *start : startOfSensorLogger(gyro_file)), gyro_file);
  if (!hasIphoneSigns(folder, table.warnings)) return table;
  for (ImuSample& sample : table.samples) sample.accel = -sample.accel;
  return table;
}

ImuTable readMars(const fs::path& file) {
  ImuTable table;
  const int64_t start = firstInteger(framesOfMars(file.parent_path()));
  std::vector<AxisSample> both[2];
  const char* axes[2][3] = {{"gx[rad/s]", "gy[rad/s]", "gz[rad/s]"}, {"ax[m/s^2]", "ay[m/s^2]", "az[m/s^2]"}};
  for (int sensor = 0; sensor < 2; ++sensor) {
    CsvReader csv(file);
    csv.skipHeader();
    Warnings repeated;
    both[sensor] = readVectors(csv,
                               {columnOf(csv, "Timestamp[nanosec]"), columnOf(csv, axes[sensor][0]),
                                columnOf(csv, axes[sensor][1]), columnOf(csv, axes[sensor][2])},
                               repeated);
    if (sensor == 0) table.warnings = repeated;
  }
  table.samples = requireSome(joinAtGyroTimes(both[0], both[1], start), file);
  return table;
}

bool isOpenCamera(const fs::path& file) {
  return nameEndsWith(file, "gyro.csv") && fs::exists(besideGyro(file, "accel.csv"));
}

ImuTable readOpenCameraFiles(const fs::path& gyro_file) {
  ImuTable table;
  const auto gyro = readOpenCamera(gyro_file, table.warnings);
  const auto accel = readOpenCamera(besideGyro(gyro_file, "accel.csv"), table.warnings);
  const int64_t start = firstInteger(framesOfOpenCamera(gyro_file));
  table.samples = requireSome(joinAtGyroTimes(gyro, accel, start), gyro_file);
  return table;
}

}  // namespace redbee
