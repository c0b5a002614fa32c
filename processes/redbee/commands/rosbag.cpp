// The one command of redbee-import-rosbag.
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/rosbag/import_rosbag.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"

namespace redbee {
namespace {

const Command kRosbagCommand(CommandGroup::kFlights, kRosbagName, kRosbagDescription,
                             [](CLI::App& command) { setUpImporter(command, rosbagImporter()); });

}  // namespace
}  // namespace redbee
