#include "processes/redbee/vehicle/record.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

constexpr int kDiskFull = 3;  ///< exit code

const Command kRecordCommand(
    CommandGroup::kVehicle, "record", "record every message in split logs, until SIGINT or SIGTERM",
    [](CLI::App& command) {
      auto options = std::make_shared<RecordOptions>();
      addOutOption(command, options->out, "folder for <date>_<time>.lcm.0000, .0001, ...")
          ->required(false)
          ->capture_default_str();
      command.add_option("--split", options->split_mb, "size at which a new file is started, MB")
          ->check(numberFrom(0.001, 1e9))
          ->capture_default_str();
      command
          .add_option("--min-free", options->min_free_mb,
                      "free disk space below which it stops (exit code 3), MB")
          ->check(numberFrom(0, 1e9))
          ->capture_default_str();
      addLcmUrlOption(command, options->url);
      command.callback([options] {
        if (!runRecord(*options)) throw CLI::RuntimeError(kDiskFull);
      });
    });

}  // namespace
}  // namespace redbee
