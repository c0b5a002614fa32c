// redbee import asl | video | gopro
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/redbee/commands/commands.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/importers/import_asl.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/importers/import_video.hpp"

namespace redbee {
namespace {

void tell(const ImportSummary& summary, const std::filesystem::path& log) {
  std::filesystem::path configuration = log;
  configuration.replace_extension(".yaml");
  const bool kept = std::filesystem::exists(configuration);
  if (!kept) writeVehicleConfiguration(summary.vehicle, log);
  for (const std::string& warning : summary.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::printf("%s: %lld frames in %.3f s, %lld IMU samples (%.1f Hz), %lld altitudes\n", log.c_str(),
              static_cast<long long>(summary.frames),
              static_cast<double>(summary.last_utime - summary.first_utime) * 1e-6,
              static_cast<long long>(summary.imu_samples), summary.imu_rate_hz,
              static_cast<long long>(summary.altitudes));
  std::printf(kept ? "%s: was there before and is left as it is\n"
                   : "%s: what the recording says of its vehicle; check it before use\n",
              configuration.c_str());
}

void addAsl(CLI::App& import) {
  auto options = std::make_shared<AslImportOptions>();
  auto* command = import.add_subcommand("asl", "a folder in EuRoC's layout (mav0/cam0, imu0, altimeter0)");
  command->add_option("folder", options->folder, "the folder that holds mav0")->required();
  command->add_option("--out", options->log, "the log to write")->required();
  command->callback([options] {
    Progress progress("importing " + options->folder.string(), "frames");
    tell(importAsl(*options, progress), options->log);
  });
}

void addVideo(CLI::App& import) {
  auto options = std::make_shared<VideoImportOptions>();
  auto* command = import.add_subcommand("video", "any video, with or without an IMU recording");
  command->add_option("file", options->video, "the video, or a folder of images (with --fps)")->required();
  command->add_option("--imu", options->imu,
                      "CSV, first line names the columns: t_s,gx,gy,gz,ax,ay,az "
                      "(s on the video's clock, rad/s, m/s^2)");
  command->add_option("--width", options->width, "px; 0 keeps the video's")->capture_default_str();
  command->add_option("--fps", options->fps, "frames a second of a folder of images");
  command->add_option("--out", options->log, "the log to write")->required();
  command->callback([options] {
    Progress progress("importing " + options->video.string(), "frames");
    tell(importVideo(*options, progress), options->log);
  });
}

void addGopro(CLI::App& import) {
  auto options = std::make_shared<GoproImportOptions>();
  auto* command = import.add_subcommand("gopro", "an MP4 of a GoPro with its motion track (GPMF)");
  command->add_option("file", options->video, "the MP4")->required();
  command->add_option("--width", options->width, "px; 0 keeps the video's")->capture_default_str();
  command->add_option("--out", options->log, "the log to write")->required();
  command->callback([options] {
    Progress progress("importing " + options->video.string(), "frames");
    tell(importGopro(*options, progress), options->log);
  });
}

}  // namespace

void addImportCommand(CLI::App& app) {
  auto* import =
      app.add_subcommand("import", "turn a recording into an LCM log and a configuration beside it");
  import->require_subcommand(1);
  addAsl(*import);
  addVideo(*import);
  addGopro(*import);
}

}  // namespace redbee
