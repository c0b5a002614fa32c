#include "redbee/importers/import_gopro.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>

#include "redbee/files/input_error.hpp"
#include "redbee/importers/data_track.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/gpmf.hpp"
#include "redbee/importers/video_log.hpp"
#include "redbee/importers/video_reader.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct UnusableImu : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// GX020001.MP4 is chapter 2 of recording 0001; empty where the name is another.
std::string recordingOf(const fs::path& file) {
  static const std::regex pattern("G[A-Z][0-9]{2}([0-9]{4})", std::regex::icase);
  std::smatch match;
  const std::string stem = file.stem().string();
  return std::regex_match(stem, match, pattern) ? match[1].str() : "";
}

/// In the order of the chapters where they have the camera's names, otherwise as given.
std::vector<fs::path> chaptersOf(const ImportOptions& options) {
  std::vector<fs::path> files{options.source};
  files.insert(files.end(), options.further_sources.begin(), options.further_sources.end());
  const std::string recording = recordingOf(files.front());
  for (const fs::path& file : files) {
    if (recording.empty() || recordingOf(file).empty()) return files;
    if (recordingOf(file) != recording)
      throw InputError(file,
                       "is no chapter of recording " + recording + ", as " + files.front().string() + " is");
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); });
  return files;
}

/// A chapter begins where the one before ends.
std::vector<VideoSource> onOneClock(const std::vector<fs::path>& files) {
  std::vector<VideoSource> sources;
  int64_t start_us = 0;
  for (const fs::path& file : files) {
    sources.push_back({file, start_us});
    const int64_t duration_us = VideoReader(file, {}).duration();
    if (duration_us == 0 && file != files.back())
      throw InputError(file, "does not state how long it is: the next chapter has no start");
    start_us += duration_us;
  }
  return sources;
}

/// The recorder's clock starts again with each chapter, so that each is fitted to the video's by itself.
std::vector<ImuSample> imuOf(const VideoSource& source) {
  std::vector<DataPacket> packets = readDataTrack(source.file, "gpmd");
  if (packets.empty()) throw InputError(source.file, "has no GPMF track: import it as a video");
  if (const auto reason = reasonToLeaveOut(packets)) throw UnusableImu(*reason);
  for (DataPacket& packet : packets) packet.start_s += 1e-6 * static_cast<double>(source.start_us);
  return mergeAtGyroTimes(readGoproStreams(packets));
}

std::vector<ImuSample> imuOf(const std::vector<VideoSource>& sources, ImportSummary& summary) {
  std::vector<ImuSample> all;
  for (const VideoSource& source : sources) {
    try {
      for (const ImuSample& sample : imuOf(source)) {
        // The samples of two chapters may overlap by the error of the fits.
        if (all.empty() || sample.time > all.back().time) all.push_back(sample);
      }
    } catch (const UnusableImu& reason) {
      summary.warnings.emplace_back(reason.what());
      return {};
    } catch (const GpmfError& error) {
      throw InputError(source.file, error.what());
    }
  }
  return all;
}

/// The optical axis of C is I's x; x of C is to the right, y down, in images turned clockwise by
/// `rotation_deg`.
Eigen::Matrix3d mounting(int rotation_deg) {
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  Eigen::Matrix3d quarter;  // what was to the right lies below
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (int turned = 0; turned < rotation_deg; turned += 90) R_CI = quarter * R_CI;
  return R_CI;
}

ImportSummary importGopro(const ImportOptions& options, Progress& progress) {
  ImportSummary summary;
  summary.vehicle.name = options.source.stem().string();
  const std::vector<VideoSource> sources = onOneClock(chaptersOf(options));
  FlightMerger merger(options.log, options.channels, imuOf(sources, summary), {});
  for (const VideoSource& source : sources) {
    const VideoPart part = addVideoFrames(source, options, merger, summary, progress);
    summary.vehicle.R_CI = mounting(part.rotation_deg);
  }
  merger.close(summary);
  return summary;
}

}  // namespace

Importer goproImporter() {
  Importer importer;
  importer.name = "gopro";
  importer.description = "MP4 of a GoPro with its motion track (GPMF)";
  importer.source = "MP4 file; several: the chapters of one recording";
  importer.takes.width = true;
  importer.takes.chapters = true;
  importer.takes.keep_going = true;
  importer.defaults.width = 854;
  importer.import = importGopro;
  return importer;
}

}  // namespace redbee
