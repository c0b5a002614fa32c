// redbee export KIND: a flight for other tools.
#include <CLI/CLI.hpp>

#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/export_targets.hpp"

namespace redbee {
namespace {

const Command kExportCommand(CommandGroup::kFlights, "export", "write a flight for other tools: maps",
                             [](CLI::App& command) {
                               command.require_subcommand(1);
                               addTargetExports(command);
                             });

}  // namespace
}  // namespace redbee
