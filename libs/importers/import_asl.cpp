#include "redbee/importers/import_asl.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/row_times.hpp"
#include "redbee/importers/sensor_yaml.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct NamedFrame {
  CameraTime time{};
  std::string name;
  int line = 0;
};

fs::path findVehicleFolder(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "no such folder");
  if (fs::is_directory(folder / "mav0")) return folder / "mav0";
  if (fs::is_directory(folder / "cam0")) return folder;
  throw InputError(folder, "holds neither mav0 nor cam0");
}

/// Kalibr's own layout (kalibr_bagcreater): DIR/cam0/<ns>.png and DIR/imu0.csv, without a list of images.
bool hasKalibrsLayout(const fs::path& camera) {
  return fs::is_directory(camera) && !fs::is_directory(camera / "data") && !fs::exists(camera / "data.csv");
}

std::vector<NamedFrame> readFrameNames(const fs::path& folder, ImportSummary& summary) {
  std::vector<NamedFrame> frames;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string(), time = entry.path().stem().string();
    int64_t time_ns = 0;
    const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), time_ns);
    const bool is_time = !time.empty() && error == std::errc() && end == time.data() + time.size();
    if (is_time) frames.push_back({CameraTime(fromNanoseconds(time_ns)), name, 0});
  }
  std::sort(frames.begin(), frames.end(),
            [](const NamedFrame& a, const NamedFrame& b) { return a.time < b.time; });
  if (frames.empty())
    throw InputError(folder, "holds neither data.csv nor images named by their time in ns (Kalibr's layout)");
  for (size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].time == frames[i - 1].time)
      throw InputError(folder / frames[i].name, "is within a microsecond of " + frames[i - 1].name);
  }
  std::vector<int64_t> utimes;
  utimes.reserve(frames.size());
  for (const NamedFrame& frame : frames) utimes.push_back(toUtime(frame.time));
  const TimeFindings findings = checkTimes(utimes, TimeOrder::kSorted, folder.string());
  for (const std::string& line : findings.lines) summary.warnings.push_back(folder.string() + ": " + line);
  return thoseKept(frames, findings.keep);
}

std::vector<NamedFrame> readFrameList(const fs::path& file, ImportSummary& summary) {
  CsvReader csv(file);
  csv.skipHeader();
  RowTimes times;
  std::vector<NamedFrame> frames;
  while (csv.next(2)) {
    const CameraTime time(fromNanoseconds(csv.integer(0)));
    times.add(csv, toUtime(time));
    if (csv.fields()[1].empty()) csv.fail("names no image");
    frames.push_back({time, csv.fields()[1], csv.line()});
  }
  if (frames.empty()) throw InputError(file, "lists no images");
  times.check(frames, summary.warnings);
  return frames;
}

std::vector<ImuSample> readImu(const fs::path& file, const ImuUnits& units, ImportSummary& summary) {
  const double to_rad_s = factorOf(gyroUnits(), units.gyro, "--gyro-unit");
  const double to_m_s2 = factorOf(accelUnits(), units.accel, "--accel-unit");
  CsvReader csv(file);
  csv.skipHeader();
  RowTimes times;
  std::vector<ImuSample> samples;
  while (csv.next(7)) {
    ImuSample sample;
    sample.time = ImuTime(fromNanoseconds(csv.integer(0)));
    times.add(csv, toUtime(sample.time));
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] = to_rad_s * csv.number(static_cast<size_t>(1 + axis));
      sample.accel[axis] = to_m_s2 * csv.number(static_cast<size_t>(4 + axis));
    }
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError(file, "holds no samples");
  times.check(samples, summary.warnings);
  return samples;
}

std::vector<AltitudeSample> readAltitudes(const fs::path& folder, ImportSummary& summary) {
  if (!fs::is_directory(folder)) return {};
  const double sigma = readAltimeterSigma(folder / "sensor.yaml");
  CsvReader csv(folder / "data.csv");
  csv.skipHeader();
  RowTimes times;
  std::vector<AltitudeSample> samples;
  while (csv.next(2)) {
    const ImuTime time(fromNanoseconds(csv.integer(0)));
    times.add(csv, toUtime(time));
    samples.push_back({time, csv.number(1), sigma});
  }
  times.check(samples, summary.warnings);
  return samples;
}

void describeExtrinsics(const SensorPose& camera, const SensorPose& imu, VehicleDescription& vehicle) {
  vehicle.R_CI = camera.R_BS.transpose() * imu.R_BS;
  vehicle.p_IC = imu.R_BS.transpose() * (camera.p_BS - imu.p_BS);
}

/// Reads the sensor.yaml files. One that is absent is a warning: the flight replays without it.
void describeVehicle(const fs::path& mav, bool has_imu, ImportSummary& summary) {
  const fs::path camera_file = mav / "cam0" / "sensor.yaml";
  const fs::path imu_file = mav / "imu0" / "sensor.yaml";
  CameraSensor camera;
  if (fs::exists(camera_file)) {
    camera = readCameraSensor(camera_file);
    summary.vehicle.intrinsics = camera.intrinsics;
  } else {
    summary.warnings.push_back(camera_file.string() +
                               ": no such file, the camera's calibration is not known");
  }
  if (!has_imu) return;
  ImuSensor imu;
  if (fs::exists(imu_file)) {
    imu = readImuSensor(imu_file);
    summary.vehicle.noise = imu.noise;
  } else {
    summary.warnings.push_back(imu_file.string() + ": no such file, the IMU's noise is not known");
  }
  if (camera.pose) describeExtrinsics(*camera.pose, imu.pose.value_or(SensorPose{}), summary.vehicle);
}

std::vector<fs::path> listedFiles(const fs::path& list, const std::vector<NamedFrame>& frames) {
  std::vector<fs::path> files;
  const fs::path camera = list.parent_path();
  const fs::path folder = hasKalibrsLayout(camera) ? camera : camera / "data";
  for (const NamedFrame& frame : frames) {
    files.push_back(folder / frame.name);
    if (!fs::exists(files.back()))
      throw InputError(list, frame.line, "image " + files.back().string() + " is missing");
  }
  return files;
}

void checkAgainstCalibration(const fs::path& camera_folder, const image_t& first,
                             const VehicleDescription& vehicle) {
  if (!vehicle.intrinsics) return;
  if (vehicle.intrinsics->width != first.width || vehicle.intrinsics->height != first.height) {
    throw InputError(camera_folder / "sensor.yaml",
                     "resolution is " + std::to_string(vehicle.intrinsics->width) + "x" +
                         std::to_string(vehicle.intrinsics->height) + " px, the images have " +
                         std::to_string(first.width) + "x" + std::to_string(first.height));
  }
}

void addListedFrames(const fs::path& list, const std::vector<NamedFrame>& frames,
                     const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
                     Progress& progress) {
  const std::vector<fs::path> files = listedFiles(list, frames);
  const ImageOptions images{true, options.jpeg_quality, rangeOf(files)};
  ResolutionCheck resolution;
  for (size_t i = 0; i < files.size(); ++i) {
    const image_t image = loadImage(files[i], toUtime(frames[i].time), images).message;
    resolution.check(files[i], image);
    if (i == 0) {
      checkAgainstCalibration(list.parent_path(), image, summary.vehicle);
      summary.vehicle.width = image.width;
      summary.vehicle.height = image.height;
    }
    merger.addFrame(image);
    progress.update(static_cast<int64_t>(i) + 1, static_cast<int64_t>(files.size()));
  }
}

ImportSummary importAsl(const ImportOptions& options, Progress& progress) {
  const fs::path mav = findVehicleFolder(options.source);
  const fs::path list = mav / "cam0" / "data.csv";
  const bool is_kalibrs = hasKalibrsLayout(mav / "cam0");
  ImportSummary summary;
  const std::vector<NamedFrame> frames =
      is_kalibrs ? readFrameNames(mav / "cam0", summary) : readFrameList(list, summary);
  const fs::path imu_file = is_kalibrs ? mav / "imu0.csv" : mav / "imu0" / "data.csv";
  const bool has_imu = is_kalibrs ? fs::exists(imu_file) : fs::is_directory(mav / "imu0");
  const std::vector<ImuSample> imu =
      has_imu ? readImu(imu_file, options.units, summary) : std::vector<ImuSample>{};
  const std::vector<AltitudeSample> altitudes = readAltitudes(mav / "altimeter0", summary);

  describeVehicle(mav, has_imu, summary);
  summary.vehicle.name =
      fs::weakly_canonical(mav.filename() == "mav0" ? mav.parent_path() : mav).filename().string();
  summary.vehicle.start_height = startHeight(altitudes, toImu(frames.front().time, Duration(0)));

  FlightMerger merger(options.log, options.channels, imu, altitudes);
  if (has_imu) merger.requirePlausibleImu(imu_file, options.units);
  addListedFrames(list, frames, options, merger, summary, progress);
  merger.close(summary);
  return summary;
}

}  // namespace

Importer aslImporter() {
  Importer importer;
  importer.name = "asl";
  importer.description = "folder in EuRoC's layout (mav0/cam0, imu0, altimeter0)";
  importer.source = "folder that holds mav0";
  importer.takes.units = true;
  importer.defaults.jpeg_quality = 95;
  importer.import = importAsl;
  return importer;
}

}  // namespace redbee
