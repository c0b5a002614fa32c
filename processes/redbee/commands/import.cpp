// redbee import asl | video | gopro
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/importers/import_asl.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {
namespace {

void printSummary(const ImportSummary& summary, const std::filesystem::path& log) {
  std::filesystem::path configuration = log;
  configuration.replace_extension(".yaml");
  const bool exists = std::filesystem::exists(configuration);
  if (!exists) writeVehicleConfiguration(summary.vehicle, log);
  for (const std::string& warning : summary.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::printf("%s: %lld frames in %.3f s, %lld IMU samples (%.1f Hz), %lld altitudes\n", log.c_str(),
              static_cast<long long>(summary.frames),
              seconds(fromUtime(summary.last_utime - summary.first_utime)),
              static_cast<long long>(summary.imu_samples), summary.imu_rate_hz,
              static_cast<long long>(summary.altitudes));
  std::printf(exists ? "%s: exists and is left as it is\n"
                     : "%s: the vehicle as the recording describes it; check it before use\n",
              configuration.c_str());
}

void addAsl(CLI::App& import) {
  auto options = std::make_shared<AslImportOptions>();
  auto* command = import.add_subcommand("asl", "folder in EuRoC's layout (mav0/cam0, imu0, altimeter0)");
  command->add_option("folder", options->folder, "folder that holds mav0")->required();
  addOutOption(*command, options->log, "log to write; the vehicle's configuration goes beside it");
  command->callback([options] {
    Progress progress("importing " + options->folder.string(), "frames");
    printSummary(importAsl(*options, progress), options->log);
  });
}

void addVideo(CLI::App& import) {
  auto options = std::make_shared<VideoImportOptions>();
  auto* command = import.add_subcommand("video", "any video, with or without an IMU recording");
  command->add_option("file", options->video, "video, or folder of images (with --fps)")->required();
  command->add_option("--imu", options->imu,
                      "IMU samples, CSV with the columns t_s,gx,gy,gz,ax,ay,az in its first line "
                      "(s since the start of the video, rad/s, m/s^2)");
  command->add_option("--width", options->width, "width of the images, px; 0: as in the video")
      ->capture_default_str();
  command->add_option("--fps", options->fps, "frames per second of a folder of images");
  addOutOption(*command, options->log, "log to write; the vehicle's configuration goes beside it");
  command->callback([options] {
    Progress progress("importing " + options->video.string(), "frames");
    printSummary(importVideo(*options, progress), options->log);
  });
}

void addGopro(CLI::App& import) {
  auto options = std::make_shared<GoproImportOptions>();
  auto* command = import.add_subcommand("gopro", "MP4 of a GoPro with its motion track (GPMF)");
  command->add_option("file", options->video, "MP4 file")->required();
  command->add_option("--width", options->width, "width of the images, px; 0: as in the video")
      ->capture_default_str();
  addOutOption(*command, options->log, "log to write; the vehicle's configuration goes beside it");
  command->callback([options] {
    Progress progress("importing " + options->video.string(), "frames");
    printSummary(importGopro(*options, progress), options->log);
  });
}

const Command kImport(CommandGroup::kFlights, "import",
                      "turn a recording into an LCM log and a vehicle configuration beside it",
                      [](CLI::App& command) {
                        command.require_subcommand(1);
                        addAsl(command);
                        addVideo(command);
                        addGopro(command);
                      });

}  // namespace
}  // namespace redbee
