#include "redbee/importers/import_gopro.hpp"

#include "redbee/files/input_error.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/gpmf.hpp"
#include "redbee/importers/video_log.hpp"
#include "redbee/importers/video_reader.hpp"

namespace redbee {
namespace {

std::vector<ImuSample> imuOf(const std::filesystem::path& video) {
  const std::vector<DataPacket> packets = readDataTrack(video, "gpmd");
  if (packets.empty()) throw InputError(video, "has no GPMF track: import it as a video");
  try {
    return mergeAtGyroTimes(readGoproStreams(packets));
  } catch (const GpmfError& error) {
    throw InputError(video, error.what());
  }
}

/// The optical axis of C is I's x; x of C is to the right, y down.
Eigen::Matrix3d nominalMounting() {
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return R_CI;
}

ImportSummary importGopro(const ImportOptions& options, Progress& progress) {
  ImportSummary summary;
  summary.vehicle.name = options.source.stem().string();
  summary.vehicle.R_CI = nominalMounting();
  FlightMerger merger(options.log, options.channels, imuOf(options.source), {});
  addVideoFrames(options, merger, summary, progress);
  merger.close(summary);
  return summary;
}

}  // namespace

Importer goproImporter() {
  Importer importer;
  importer.name = "gopro";
  importer.description = "MP4 of a GoPro with its motion track (GPMF)";
  importer.source = "MP4 file";
  importer.takes.width = true;
  importer.defaults.width = 854;
  importer.import = importGopro;
  return importer;
}

}  // namespace redbee
