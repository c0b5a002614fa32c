#include "redbee/configuration/configuration.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kConfigurationCommand(
    CommandGroup::kVehicle, "configuration",
    "print the value of every configuration key, with includes and defaults resolved", [](CLI::App& command) {
      auto file = std::make_shared<std::filesystem::path>();
      addConfigurationOption(command, *file);
      command.callback([file] { std::fputs(emitYaml(loadConfiguration(*file)).c_str(), stdout); });
    });

}  // namespace
}  // namespace redbee
