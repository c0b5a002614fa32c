#include "redbee/importers/import_gopro.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>

#include "redbee/files/input_error.hpp"
#include "redbee/importers/data_track.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/gopro_orientation.hpp"
#include "redbee/importers/gpmf.hpp"
#include "redbee/importers/video_log.hpp"
#include "redbee/importers/video_reader.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastTurn_deg = 0.5;

struct UnusableImu : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Chapter {
  std::string recording;
  int number = 0;
  fs::path file;
};

/// GX020001.MP4 is chapter 2 of recording 0001; older cameras begin with GOPR0001.MP4 and go on with
/// GP010001.MP4. std::nullopt where the name is another.
std::optional<Chapter> chapterOf(const fs::path& file) {
  static const std::regex pattern("G(?:OPR|[A-Z]([0-9]{2}))([0-9]{4})", std::regex::icase);
  std::smatch match;
  const std::string stem = file.stem().string();
  if (!std::regex_match(stem, match, pattern)) return std::nullopt;
  return Chapter{match[2].str(), match[1].matched ? std::stoi(match[1].str()) : 0, file};
}

/// In the order of the chapters where they have the camera's names, otherwise as given.
std::vector<fs::path> chaptersOf(const ImportOptions& options) {
  std::vector<fs::path> files{options.source};
  files.insert(files.end(), options.further_sources.begin(), options.further_sources.end());
  std::vector<Chapter> chapters;
  for (const fs::path& file : files) {
    const auto chapter = chapterOf(file);
    if (!chapter) return files;
    const std::string& recording = chapters.empty() ? chapter->recording : chapters.front().recording;
    if (chapter->recording != recording)
      throw InputError(file,
                       "is no chapter of recording " + recording + ", as " + files.front().string() + " is");
    chapters.push_back(*chapter);
  }
  std::sort(chapters.begin(), chapters.end(),
            [](const Chapter& a, const Chapter& b) { return a.number < b.number; });
  // The times of what follows a gap would be those of what is missing.
  for (size_t k = 1; k < chapters.size(); ++k) {
    const Chapter& before = chapters[k - 1];
    const Chapter& chapter = chapters[k];
    if (chapter.number == before.number)
      throw InputError(chapter.file, fmt::format("is chapter {} of recording {}, as {} is", chapter.number,
                                                 chapter.recording, before.file.string()));
    if (chapter.number != before.number + 1)
      throw InputError(
          chapter.file,
          fmt::format("chapter {} of recording {} is missing before it: give that too, or import "
                      "what is on each side of the gap by itself",
                      before.number + 1, chapter.recording));
  }
  for (size_t k = 0; k < chapters.size(); ++k) files[k] = chapters[k].file;
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

/// What the motion track says of the camera's and of its images' rotation.
struct Motion {
  std::vector<ImuSample> imu;
  std::vector<MountSample> turns;  ///< of images that were stabilised, on the IMU's clock
  std::optional<double> lag_s;     ///< frameLag() of those
  std::string damage;              ///< a line about what is left out
};

/// The recorder's clock starts again with each chapter, so that each is fitted to the video's by itself.
Motion motionOf(const VideoSource& source) {
  std::vector<DataPacket> packets = readDataTrack(source.file, "gpmd");
  if (packets.empty()) throw InputError(source.file, "has no GPMF track: import it as a video");
  if (const auto reason = reasonToLeaveOut(packets)) throw UnusableImu(*reason);
  for (DataPacket& packet : packets) packet.start_s += 1e-6 * static_cast<double>(source.start_us);
  const GoproStreams streams = readGoproStreams(packets);
  Motion motion{mergeAtGyroTimes(streams), imageTurns(packets), {}, streams.damage};
  if (!motion.turns.empty()) motion.lag_s = frameLag(packets, streams);
  return motion;
}

/// Turns at the times of the frames on the IMU's clock.
void putOnImuClock(Motion& motion) {
  for (MountSample& turn : motion.turns) turn.time += fromSeconds(motion.lag_s.value_or(0));
}

void describeTurns(const Motion& all, ImportSummary& summary) {
  // Of IORI's 16 bits, and of CORI against the gyro.
  constexpr double kSigma_deg = 0.02;
  if (all.turns.empty()) return;
  summary.vehicle.mount_sigma_deg = kSigma_deg;
  summary.vehicle.timeshift_s = all.lag_s;
  summary.warnings.push_back(fmt::format(
      "the camera stabilised the video and turned its images by up to {:.1f} degrees: GIMBAL says how, by "
      "the recording's IORI; a rolling shutter is not corrected",
      largestTurn_deg(all.turns)));
}

Motion motionOf(const std::vector<VideoSource>& sources, ImportSummary& summary) {
  Motion all;
  for (const VideoSource& source : sources) {
    try {
      Motion part = motionOf(source);
      if (!part.damage.empty()) summary.warnings.push_back(source.file.string() + ": " + part.damage);
      if (all.lag_s) part.lag_s = all.lag_s;  // one camera, one lag
      all.lag_s = part.lag_s;
      putOnImuClock(part);
      all.turns.insert(all.turns.end(), part.turns.begin(), part.turns.end());
      for (const ImuSample& sample : part.imu) {
        // The samples of two chapters may overlap by the error of the fits.
        if (all.imu.empty() || sample.time > all.imu.back().time) all.imu.push_back(sample);
      }
    } catch (const UnusableImu& reason) {
      summary.warnings.emplace_back(reason.what());
      return {};
    } catch (const GpmfError& error) {
      throw InputError(source.file, error.what());
    }
  }
  // Half a degree of the mounting already shows (config/README.md).
  if (largestTurn_deg(all.turns) <= kLeastTurn_deg) all.turns.clear();
  describeTurns(all, summary);
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
  const Motion motion = motionOf(sources, summary);
  FlightMerger merger(options.log, options.channels, motion.imu, {});
  merger.addMount(motion.turns);
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
