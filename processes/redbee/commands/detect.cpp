#include "processes/redbee/detect/detect.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kDetectCommand(
    CommandGroup::kFlights, "detect",
    "run the whole stack over a recorded flight, in one process, without losing a frame",
    [](CLI::App& command) {
      auto options = std::make_shared<DetectOptions>();
      addLogOption(command, options->log)->required();
      addConfigurationOption(command, options->configuration);
      addOutOption(command, options->out, "folder for maps, tables and summary.json");
      command
          .add_option(
              "--method", options->method,
              "redbee: as configured; default or paper: that preset; otherwise a method for comparison. "
              "One of: " +
                  methodList())
          ->capture_default_str();
      command
          .add_option("--set", options->settings,
                      "key=value, overrides the configuration; can be given several times")
          ->allow_extra_args(false);
      command.add_option("--frames", options->frames, "stop after this many frames of the log")
          ->check(CLI::PositiveNumber);
      auto* rate = command.add_option("--rate", options->rate, "replay speed; 1 is the log's own")
                       ->check(numberFrom(0.001, 1000));
      command.add_flag("--max-rate", "as fast as possible (the default without --rate)")->excludes(rate);
      command.callback([options] {
        const int64_t frames = runDetect(*options);
        std::printf("%lld frames, results in %s\n", static_cast<long long>(frames), options->out.c_str());
      });
    });

}  // namespace
}  // namespace redbee
