#include "processes/redbee/commands/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "redbee/bus/build_version.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/input_error.hpp"

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
  try {
    addCommands(app);
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "redbee: %s (see redbee --help)\n", error.what());
    return 2;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const ConfigurationError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "%s: %s\n", error.path1().c_str(), error.code().message().c_str());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "redbee: %s\n", error.what());
    return 1;
  }
}

}  // namespace redbee
