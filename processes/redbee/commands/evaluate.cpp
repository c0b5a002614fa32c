#include "processes/redbee/evaluate/evaluate.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kEvaluateCommand(
    CommandGroup::kEvaluation, "evaluate", "measure the maps of a run against ground-truth masks",
    [](CLI::App& command) {
      auto options = std::make_shared<EvaluateOptions>();
      command
          .add_option("--truth", options->truth,
                      "folder of masks, or of a flight or sequence (with labels/mask or mask); none: nothing "
                      "moves in the recording")
          ->required();
      addResultsOption(command, options->results);
      addLogOption(command, options->log)
          ->description(
              "recorded flight, an LCM log: to draw hits and misses, and for masks named by frame number");
      command.add_option("--camera", options->camera_channel, "channel of the images in the log")
          ->capture_default_str();
      command.add_option("--frames", options->frames, "evaluate only the first frames of the recording")
          ->check(CLI::PositiveNumber);
      command.callback([options] { runEvaluate(*options); });
    });

}  // namespace
}  // namespace redbee
