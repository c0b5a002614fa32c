// The one command of redbee-import-rosbag.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/rosbag/import_rosbag.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"

namespace redbee {
namespace {

/// The help names the command as it is called, `redbee import rosbag`, which starts this program.
class Formatter : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string /*name*/) const override {
    return CLI::Formatter::make_usage(app, std::string("redbee import ") + kRosbagName);
  }
};

const Command kRosbagCommand(CommandGroup::kFlights, kRosbagName, kRosbagDescription, [](CLI::App& command) {
  command.formatter(std::make_shared<Formatter>());
  setUpImporter(command, rosbagImporter());
});

}  // namespace
}  // namespace redbee
