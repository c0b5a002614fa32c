#include "processes/redbee/commands/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "processes/exit_code.hpp"
#include "redbee/bus/build_version.hpp"

namespace redbee {
namespace {

std::vector<Command>& registry() {
  static std::vector<Command> commands;  // of a function: it exists before the first command registers
  return commands;
}

const char* headingOf(CommandGroup group) {
  switch (group) {
    case CommandGroup::kFlights:
      return "Recorded flights";
    case CommandGroup::kEvaluation:
      return "Evaluation";
    case CommandGroup::kVehicle:
      return "Beside the running processes";
  }
  return "";
}

void addCommands(CLI::App& app) {
  std::vector<Command> commands = registry();
  std::sort(commands.begin(), commands.end(), [](const Command& a, const Command& b) {
    return std::tie(a.group, a.name) < std::tie(b.group, b.name);
  });
  for (const Command& command : commands) {
    CLI::App* subcommand = app.add_subcommand(command.name, command.description);
    subcommand->group(headingOf(command.group));
    command.setup(*subcommand);
  }
}

}  // namespace

Command::Command(CommandGroup group_, std::string name_, std::string description_, Setup setup_)
    : group(group_), name(std::move(name_)), description(std::move(description_)), setup(std::move(setup_)) {
  registry().push_back(*this);
}

int runTool(int argc, char** argv) {
  CLI::App app(std::string("REDBEE ") + releaseVersion() + ": moving objects, seen from a drone", "redbee");
  app.set_version_flag("--version", buildVersion());
  app.require_subcommand(1);
  cv::setNumThreads(1);  // figures for one core, and the same sums on every machine
  return exitCodeOf(app, [&] {
    addCommands(app);
    app.parse(argc, argv);
  });
}

}  // namespace redbee
