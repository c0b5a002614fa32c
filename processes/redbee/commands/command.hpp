// A subcommand of `redbee`. Each has its own file in this folder with one static object, which registers
// itself.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace redbee {

/// Headings of `redbee --help`, in this order.
enum class CommandGroup { kFlights, kEvaluation, kVehicle };

class Command {
 public:
  /// Adds options and a callback to the subcommand. The callback throws on failure; see exitCodeOf().
  using Setup = std::function<void(CLI::App& command)>;

  Command(CommandGroup group, std::string name, std::string description, Setup setup);

  CommandGroup group;
  std::string name;
  std::string description;
  Setup setup;
};

/// Parses the command line and runs the subcommand; see exitCodeOf().
int runTool(int argc, char** argv);

}  // namespace redbee
