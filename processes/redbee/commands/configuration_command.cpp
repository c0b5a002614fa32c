// redbee configuration
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "processes/redbee/commands/commands.hpp"
#include "redbee/configuration/configuration.hpp"

namespace redbee {

void addConfigurationCommand(CLI::App& app) {
  auto file = std::make_shared<std::string>();
  auto* command =
      app.add_subcommand("configuration", "print every key as it holds, includes and defaults resolved");
  command->add_option("--config", *file, "the vehicle's YAML file")->required();
  command->callback([file] { std::fputs(emitYaml(loadConfiguration(*file)).c_str(), stdout); });
}

}  // namespace redbee
