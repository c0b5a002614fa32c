// A subcommand of `redbee`. Each lives in a file of its own in this folder, as one object with static storage
// that registers itself; nothing else has to name it.
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
  /// Adds options and a callback to the subcommand. The callback throws where it fails: runTool() turns what
  /// it throws into the exit code.
  using Setup = std::function<void(CLI::App& command)>;

  Command(CommandGroup group, std::string name, std::string description, Setup setup);

  CommandGroup group;
  std::string name;
  std::string description;
  Setup setup;
};

/// Parses the command line and runs the subcommand. 0 on success, 2 on bad use or bad input (one line on
/// stderr), 1 on any other failure; a subcommand may state a code of its own (CLI::RuntimeError).
int runTool(int argc, char** argv);

}  // namespace redbee
