#include "redbee/importers/import_video.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "redbee/bus/image.hpp"
#include "redbee/files/csv.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/video_log.hpp"
#include "redbee/importers/video_reader.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

std::array<size_t, 7> findColumns(const CsvReader& csv) {
  constexpr std::array<const char*, 7> kNames = {"t_s", "gx", "gy", "gz", "ax", "ay", "az"};
  std::array<size_t, 7> columns{};
  for (size_t i = 0; i < kNames.size(); ++i) {
    const auto& header = csv.fields();
    const auto found = std::find(header.begin(), header.end(), kNames[i]);
    if (found == header.end()) {
      csv.fail(std::string("header names no column '") + kNames[i] + "' (needed: t_s gx gy gz ax ay az)");
    }
    columns[i] = static_cast<size_t>(found - header.begin());
  }
  return columns;
}

bool isImage(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

std::vector<fs::path> listImages(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && isImage(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(folder, "holds no JPEG or PNG images");
  return files;
}

void addImages(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
               Progress& progress) {
  if (!std::isfinite(options.fps) || options.fps <= 0) {
    throw InputError(options.source, "is a folder of images: a frame rate above 0 is needed");
  }
  const std::vector<fs::path> files = listImages(options.source);
  ResolutionCheck resolution;
  for (size_t i = 0; i < files.size(); ++i) {
    const int64_t utime = std::llround(1e6 * static_cast<double>(i) / options.fps);
    const image_t image = loadImage(files[i], utime, {true, options.jpeg_quality});
    resolution.check(files[i], image);
    summary.vehicle.width = image.width;
    summary.vehicle.height = image.height;
    merger.addFrame(image);
    progress.update(static_cast<int64_t>(i) + 1, static_cast<int64_t>(files.size()));
  }
}

}  // namespace

std::vector<ImuSample> readImuCsv(const fs::path& file) {
  constexpr double kLatest_s = 1e10;  // the year 2286; far beyond it microseconds overflow
  CsvReader csv(file);
  if (!csv.next(0)) throw InputError(file, "is empty");
  const auto columns = findColumns(csv);
  const size_t width = csv.fields().size();
  IncreasingTimeCheck times;
  std::vector<ImuSample> samples;
  while (csv.next(width)) {
    ImuSample sample;
    const double t_s = csv.number(columns[0]);
    if (std::abs(t_s) > kLatest_s) csv.fail("'" + csv.fields().at(columns[0]) + "' s is no time");
    sample.time = ImuTime(fromSeconds(t_s));
    times.check(csv, toUtime(sample.time));
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] = csv.number(columns[static_cast<size_t>(1 + axis)]);
      sample.accel[axis] = csv.number(columns[static_cast<size_t>(4 + axis)]);
    }
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError(file, "holds no samples");
  return samples;
}

void addVideoFrames(const ImportOptions& options, FlightMerger& merger, ImportSummary& summary,
                    Progress& progress) {
  VideoReader reader(options.source, {options.width, options.format == FrameFormat::kRawGrey});
  int64_t done = 0;
  while (const auto frame = reader.next()) {
    merger.addFrame(options.format == FrameFormat::kRawGrey
                        ? rawGreyMessage(frame->utime, frame->image)
                        : jpegMessage(frame->utime, frame->image, options.jpeg_quality));
    summary.vehicle.width = frame->image.cols;
    summary.vehicle.height = frame->image.rows;
    progress.update(++done, reader.expectedFrames());
  }
}

namespace {

ImportSummary importVideo(const ImportOptions& options, Progress& progress) {
  const std::vector<ImuSample> imu = options.imu ? readImuCsv(*options.imu) : std::vector<ImuSample>{};
  ImportSummary summary;
  summary.vehicle.name = options.source.stem().string();
  FlightMerger merger(options.log, options.channels, imu, {});
  if (fs::is_directory(options.source)) {
    addImages(options, merger, summary, progress);
  } else {
    addVideoFrames(options, merger, summary, progress);
  }
  merger.close(summary);
  return summary;
}

}  // namespace

Importer videoImporter() {
  Importer importer;
  importer.name = "video";
  importer.description = "any video, with or without an IMU recording";
  importer.source = "video, or folder of images (with --fps)";
  importer.takes = {true, true, true};
  importer.import = importVideo;
  return importer;
}

}  // namespace redbee
