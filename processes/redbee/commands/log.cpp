#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <vector>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/logs/log_repair.hpp"
#include "processes/redbee/logs/log_survey.hpp"
#include "processes/warnings.hpp"

namespace redbee {
namespace {

void addInfo(CLI::App& log) {
  auto file = std::make_shared<std::filesystem::path>();
  auto* command = log.add_subcommand("info", "list channels, types, rates, gaps, span and damage");
  command->add_option("log", *file, "recorded flight, an LCM log")->required();
  command->callback([file] { std::fputs(asText(surveyLog(*file), *file).c_str(), stdout); });
}

struct RepairOptions {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path out;
};

void addRepair(CLI::App& log) {
  auto options = std::make_shared<RepairOptions>();
  auto* command = log.add_subcommand("repair", "write what is whole of a log, or join the parts of one");
  command->add_option("logs", options->parts, "an LCM log, or its parts (F.lcm.*), in any order")->required();
  addOutOption(*command, options->out, "log to write");
  command->callback([options] {
    const LogRepair repair = repairLog(options->parts, options->out);
    printWarnings(repair.damage);
    printWarning(repair.missing);
    std::printf("%s: %lld messages\n", options->out.c_str(), static_cast<long long>(repair.messages));
  });
}

const Command kLogCommand(CommandGroup::kFlights, "log", "what a log holds; repair it, or join its parts",
                          [](CLI::App& command) {
                            command.require_subcommand(1);
                            addInfo(command);
                            addRepair(command);
                          });

}  // namespace
}  // namespace redbee
