#include "processes/redbee/vehicle/top.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kTopCommand(
    CommandGroup::kVehicle, "top", "show the health of the running processes, until q is pressed",
    [](CLI::App& command) {
      auto options = std::make_shared<TopOptions>();
      addLcmUrlOption(command, options->url);
      command.add_option("--channel", options->channel, "channel of the health messages")
          ->capture_default_str();
      auto* once = command.add_flag("--once", options->once,
                                    "print one table and end; exit code 1 if no process is running");
      command
          .add_option("--listen", options->listen_s, "with --once: how long to wait for health messages, s")
          ->check(numberFrom(0.001, 3600))
          ->needs(once)
          ->capture_default_str();
      command.callback([options] {
        if (runTop(*options) == 0 && options->once) throw CLI::RuntimeError(1);
      });
    });

}  // namespace
}  // namespace redbee
