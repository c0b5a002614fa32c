#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/evaluate/simulate_flight.hpp"

namespace redbee {
namespace {

const Command kSimulateCommand(
    CommandGroup::kFlights, "simulate", "simulate a flight with exact ground truth", [](CLI::App& command) {
      auto options = std::make_shared<SimulateOptions>();
      command.add_option("--scenario", options->scenario, "one of: " + scenarioNames())
          ->capture_default_str();
      command.add_option("--seed", options->seed, "of the random numbers: equal seeds give equal flights")
          ->capture_default_str();
      command.add_option("--seconds", options->seconds, "duration of the flight, s")
          ->check(numberFrom(0.2, 600))
          ->capture_default_str();
      command
          .add_option("--readout-ms", options->readout_ms,
                      "read-out time of a rolling shutter, ms; 0: global shutter")
          ->check(numberFrom(0, 100))
          ->capture_default_str();
      addOutOption(command, options->log, "log to write; its configuration is written beside it");
      command.add_option("--truth", options->truth, "folder for ground-truth masks and homographies");
      command.callback([options] { runSimulate(*options); });
    });

}  // namespace
}  // namespace redbee
