// redbee import KIND: one subcommand for each importer.
#include <CLI/CLI.hpp>

#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/commands/program_beside.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"
#include "redbee/importers/importer.hpp"

namespace redbee {
namespace {

void addRosbag(CLI::App& command) {
  command.set_help_flag();
  command.prefix_command();
  command.callback(
      [&command] { runProgramBeside(kRosbagProgram, kRosbagName, command.remaining(), kRosbagMissing); });
}

void addImporters(CLI::App& command) {
  command.require_subcommand(1);
  for (const Importer& importer : importers())
    setUpImporter(*command.add_subcommand(importer.name, importer.description), importer);
  addRosbag(*command.add_subcommand(kRosbagName, kRosbagDescription));
}

const Command kImportCommand(CommandGroup::kFlights, "import",
                             "turn a recording into an LCM log and a vehicle configuration beside it",
                             addImporters);

}  // namespace
}  // namespace redbee
