// redbee import KIND: one subcommand for each importer.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/importers/importer.hpp"

namespace redbee {
namespace {

void printSummary(const ImportSummary& summary, const std::filesystem::path& log) {
  std::filesystem::path configuration = log;
  configuration.replace_extension(".yaml");
  const bool exists = std::filesystem::exists(configuration);
  if (!exists) writeVehicleFile(summary.vehicle, log);
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

void addImporter(CLI::App& import, const Importer& importer) {
  auto options = std::make_shared<ImportOptions>(importer.defaults);
  auto* command = import.add_subcommand(importer.name, importer.description);
  command->add_option("source", options->source, importer.source)->required();
  if (importer.takes.imu) {
    command->add_option("--imu", options->imu,
                        "IMU samples, CSV with the columns t_s,gx,gy,gz,ax,ay,az in its first line "
                        "(s since the start of the video, rad/s, m/s^2)");
  }
  if (importer.takes.width) {
    command->add_option("--width", options->width, "width of the images, px; 0: as in the video")
        ->capture_default_str();
  }
  if (importer.takes.fps)
    command->add_option("--fps", options->fps, "frames per second of a folder of images");
  addOutOption(*command, options->log, "log to write; the vehicle's configuration goes beside it");
  command->add_option("--camchain", options->camchain,
                      "the camera's calibration: Kalibr's camchain.yaml or camchain-imucam.yaml");
  command->add_option("--camera", options->camchain_camera, "the camera's section of the camchain")
      ->capture_default_str();
  command->callback([options, importer] {
    Progress progress("importing " + options->source.string(), "frames");
    printSummary(importRecording(importer, *options, progress), options->log);
  });
}

const Command kImportCommand(CommandGroup::kFlights, "import",
                             "turn a recording into an LCM log and a vehicle configuration beside it",
                             [](CLI::App& command) {
                               command.require_subcommand(1);
                               for (const Importer& importer : importers()) addImporter(command, importer);
                             });

}  // namespace
}  // namespace redbee
