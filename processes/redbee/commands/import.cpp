// redbee import KIND: one subcommand for each importer.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/commands/program_beside.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"
#include "processes/redbee/vehicle/import_kalibr.hpp"
#include "processes/warnings.hpp"
#include "redbee/importers/importer.hpp"

namespace redbee {
namespace {

void addRosbag(CLI::App& command) {
  command.set_help_flag();
  command.prefix_command();
  command.callback(
      [&command] { runProgramBeside(kRosbagProgram, kRosbagName, command.remaining(), kRosbagMissing); });
}

void addKalibr(CLI::App& command) {
  auto options = std::make_shared<KalibrImport>();
  command.add_option("camchain", options->camchain, "Kalibr's camchain.yaml or camchain-imucam.yaml")
      ->required();
  command.add_option("--imu-noise", options->imu, "Kalibr's imu.yaml; without it the vehicle has no IMU");
  command.add_option("--camera", options->camera, "the camera's section of the camchain")
      ->capture_default_str();
  addOutOption(command, options->out, "configuration of the vehicle to write, a YAML file");
  command.callback([options] {
    printWarnings(importKalibr(*options));
    std::printf("%s: the vehicle as Kalibr calibrated it; check it before use\n", options->out.c_str());
  });
}

void addImporters(CLI::App& command) {
  command.require_subcommand(1);
  for (const Importer& importer : importers())
    setUpImporter(*command.add_subcommand(importer.name, importer.description), importer);
  addKalibr(
      *command.add_subcommand("kalibr", "Kalibr's camchain.yaml and imu.yaml, as a vehicle's configuration"));
  addRosbag(*command.add_subcommand(kRosbagName, kRosbagDescription));
}

const Command kImportCommand(CommandGroup::kFlights, "import",
                             "turn a recording into an LCM log and a vehicle configuration beside it",
                             addImporters);

}  // namespace
}  // namespace redbee
