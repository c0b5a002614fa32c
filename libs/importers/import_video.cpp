#include "redbee/importers/import_video.hpp"

#include "redbee/bus/image.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/image_folder.hpp"
#include "redbee/importers/imu_table.hpp"
#include "redbee/importers/recognise.hpp"
#include "redbee/importers/stated_lens.hpp"
#include "redbee/importers/video_log.hpp"
#include "redbee/importers/video_reader.hpp"

namespace redbee {

VideoPart addVideoFrames(const VideoSource& source, const ImportOptions& options, FlightMerger& merger,
                         ImportSummary& summary, Progress& progress) {
  const bool is_grey = options.format == FrameFormat::kRawGrey;
  VideoReader reader(source.file, {options.width, is_grey, options.fps, options.keep_going});
  int64_t done = 0;
  while (const auto frame = reader.next()) {
    const cv::Size size = frame->image.size();
    if (summary.vehicle.width != 0 && size != cv::Size(summary.vehicle.width, summary.vehicle.height))
      throw InputError(source.file, "has another image size than the file before it");
    summary.vehicle.width = size.width;
    summary.vehicle.height = size.height;
    const int64_t utime = source.start_us + frame->utime;
    merger.addFrame(is_grey ? rawGreyMessage(utime, frame->image)
                            : jpegMessage(utime, frame->image, options.jpeg_quality));
    progress.update(++done, reader.expectedFrames());
  }
  summary.vehicle.pixel_aspect = reader.pixelAspect();
  for (const std::string& warning : reader.warnings()) summary.warnings.push_back(warning);
  return {reader.rotation_deg(), reader.duration()};
}

namespace {

void addSubtitles(const std::filesystem::path& video, LensRecord& lens, FlightMerger& merger,
                  ImportSummary& summary) {
  const auto file = subtitlesBeside(video);
  if (!file) return;
  const std::vector<EquivalentFocalLength> lengths = readDjiSubtitles(*file);
  for (const EquivalentFocalLength& length : lengths) lens.add(length, merger);
  summary.warnings.push_back(file->string() + (lengths.empty()
                                                   ? ": states no focal length (focal_len): not used"
                                                   : ": gives the focal length of each image (LENS)"));
}

/// Some of them would be taken for raw streams.
void refuseOtherRecordings(const std::filesystem::path& file) {
  const std::string kind = recogniseStart(file);
  if (kind.empty()) throw InputError(file, "is a log already: redbee log info, redbee detect --log");
  if (kind != "video") throw InputError(file, "is no video: redbee import " + kind);
}

ImportSummary importVideo(const ImportOptions& options, Progress& progress) {
  const bool is_folder = std::filesystem::is_directory(options.source);
  if (!is_folder) refuseOtherRecordings(options.source);
  const ImuTable imu = options.imu ? readImuTable(*options.imu, options.source, options.units) : ImuTable{};
  ImportSummary summary;
  summary.vehicle.name = options.source.stem().string();
  summary.warnings = imu.warnings;
  FlightMerger merger(options.log, options.channels, imu.samples, {});
  if (options.imu) merger.requirePlausibleImu(*options.imu, imu.units);
  if (is_folder) {
    addImages(options, merger, summary, progress);
  } else {
    LensRecord lens;
    addSubtitles(options.source, lens, merger, summary);
    addVideoFrames({options.source}, options, merger, summary, progress);
    lens.describe(summary);
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
  importer.takes.width = true;
  importer.takes.fps = true;
  importer.takes.imu = true;
  importer.takes.units = true;
  importer.takes.keep_going = true;
  importer.import = importVideo;
  return importer;
}

}  // namespace redbee
