#include "processes/redbee/vehicle/watch.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kWatchCommand(CommandGroup::kVehicle, "watch",
                            "report processes that exit, and kill those that hang, until SIGINT or SIGTERM",
                            [](CLI::App& command) {
                              auto options = std::make_shared<WatchOptions>();
                              addConfigurationOption(command, options->configuration);
                              addLcmUrlOption(command, options->url);
                              command.callback([options] {
                                const int status = runWatch(*options);
                                if (status != 0) throw CLI::RuntimeError(status);
                              });
                            });

}  // namespace
}  // namespace redbee
