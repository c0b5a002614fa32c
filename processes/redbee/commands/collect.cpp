#include "processes/redbee/detect/collect.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kCollectCommand(CommandGroup::kVehicle, "collect",
                              "save the results of the running processes, until SIGINT or SIGTERM",
                              [](CLI::App& command) {
                                auto options = std::make_shared<CollectOptions>();
                                addConfigurationOption(command, options->configuration);
                                addLcmUrlOption(command, options->url);
                                addOutOption(command, options->out,
                                             "folder for maps, tables and summary.json");
                                command.callback([options] {
                                  const int64_t frames = runCollect(*options);
                                  std::printf("%lld frames, results in %s\n", static_cast<long long>(frames),
                                              options->out.c_str());
                                });
                              });

}  // namespace
}  // namespace redbee
