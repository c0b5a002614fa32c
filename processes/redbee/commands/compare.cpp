#include "processes/redbee/evaluate/compare.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kCompareCommand(
    CommandGroup::kEvaluation, "compare", "make tables and a page of the runs of scripts/evaluate",
    [](CLI::App& command) {
      auto options = std::make_shared<CompareOptions>();
      command.add_option("--cells", options->cells, "folder of runs, SET/CLIP/EXTRINSICS/METHOD")->required();
      command.add_option("--clips", options->clips, "list of clips")->required();
      command.add_option("--methods", options->methods, "list of methods")->required();
      command
          .add_option("--extrinsics", options->extrinsics, "variants of the extrinsics, separated by commas")
          ->delimiter(',')
          ->required();
      addOutOption(command, options->out, "folder for the tables and the page");
      command.callback([options] { runCompare(*options); });
    });

}  // namespace
}  // namespace redbee
