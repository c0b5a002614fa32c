#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/program_beside.hpp"
#include "processes/redbee/vehicle/supervisor_configuration.hpp"
#include "redbee/configuration/drivers.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {
namespace {

struct StackOptions {
  bool names = false;
  bool programs = false;
  bool supervisord = false;
  bool print_url = false;
  std::filesystem::path configuration;
  std::string url;
};

std::string joined(const KeyList& keys) {
  std::string text;
  for (const std::string_view key : keys) text += (text.empty() ? "" : ",") + std::string(key);
  return text.empty() ? "-" : text;
}

void printTable() {
  const char* format = "%-20s %-28s %-9s %-5s %-36s %-40s %s\n";
  std::printf(format, "NAME", "PROGRAM", "MEMORY_MB", "PRIO", "PUBLISHES", "WAITS_FOR", "TIMEOUT");
  const auto print = [&](const ProcessDescription& process) {
    const std::string program =
        process.subcommand.empty() ? programName(process) : "redbee " + std::string(process.subcommand);
    std::printf(format, std::string(process.name).c_str(), program.c_str(),
                std::to_string(process.memory_limit / 1'000'000).c_str(),
                std::to_string(process.priority).c_str(), joined(process.publishes).c_str(),
                joined(process.waits_for).c_str(),
                process.timeout.empty() ? "-" : ("waits." + std::string(process.timeout)).c_str());
  };
  for (const auto* process : kStages) print(*process);
  std::string missing;
  for (const auto* process : kDrivers) {
    if (isBeside(programName(*process))) {
      print(*process);
    } else {
      missing += (missing.empty() ? "" : ", ") + programName(*process);
    }
  }
  for (const auto* process : kSupportProcesses) print(*process);
  if (!missing.empty()) std::printf("not installed here: %s\n", missing.c_str());
}

/// Throws UserError for one whose program is not there: supervisor would start it without end.
std::vector<const ProcessDescription*> driversOf(const std::filesystem::path& file) {
  const auto drivers = configuredDrivers(loadConfiguration(file));
  for (const auto* driver : drivers) {
    const std::string program = programName(*driver);
    if (isBeside(program)) continue;
    const bool needs_packages = driver == &kCamera || driver == &kServe;
    const std::string packages =
        needs_packages ? "scripts/setup scripts/packages-" + std::string(driver->name) + ".txt and " : "";
    throw UserError(file.string() + ": wants " + program + ", which is not here: install its package, or " +
                    packages + "scripts/build");
  }
  return drivers;
}

void runStack(const StackOptions& options) {
  if (options.supervisord) {
    const auto drivers = options.configuration.empty() ? std::vector<const ProcessDescription*>{}
                                                       : driversOf(options.configuration);
    std::fputs(supervisorConfiguration(drivers).c_str(), stdout);
  } else if (options.print_url) {
    std::printf("%s\n", options.url.c_str());
  } else if (options.names || options.programs) {
    for (const auto* stage : kStages)
      std::printf("%s\n", options.names ? std::string(stage->name).c_str() : programName(*stage).c_str());
  } else {
    printTable();
  }
}

const Command kStackCommand(
    CommandGroup::kVehicle, "stack", "print the table of processes, for people and for scripts",
    [](CLI::App& command) {
      auto options = std::make_shared<StackOptions>();
      auto* output = command.add_option_group("output", "instead of the table");
      output->add_flag("--names", options->names, "names of the processes that a frame passes through");
      output->add_flag("--programs", options->programs, "their programs");
      output->add_flag("--supervisord", options->supervisord, "the configuration for supervisor");
      output->add_flag("--print-url", options->print_url, "the LCM URL that every program uses here");
      output->require_option(0, 1);
      command.add_option("--config", options->configuration,
                         "configuration of the vehicle: --supervisord has its drivers, too");
      addLcmUrlOption(command, options->url);
      command.callback([options] { runStack(*options); });
    });

}  // namespace
}  // namespace redbee
