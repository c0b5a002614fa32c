// The subcommands beside the running processes.
#include <CLI/CLI.hpp>
#include <memory>

#include "processes/redbee/commands/commands.hpp"
#include "processes/redbee/vehicle/record.hpp"
#include "processes/redbee/vehicle/top.hpp"
#include "processes/redbee/vehicle/watch.hpp"
#include "redbee/bus/receive_buffer.hpp"

namespace redbee {

void addTopCommand(CLI::App& app) {
  auto options = std::make_shared<TopOptions>();
  options->url = kDefaultLcmUrl;
  auto* command = app.add_subcommand("top", "how the processes fare, until q is pressed");
  command->add_option("--lcm-url", options->url, "where the messages are")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  command->add_option("--channel", options->channel, "of PROCESS_HEALTH")->capture_default_str();
  auto* once =
      command->add_flag("--once", options->once, "print one table and end; exit 1 where nobody is heard");
  command->add_option("--listen", options->listen_s, "s, how long to listen for it")
      ->check(CLI::PositiveNumber)
      ->needs(once)
      ->capture_default_str();
  command->callback([options] {
    if (runTop(*options) == 0 && options->once) throw CLI::RuntimeError(1);
  });
}

void addWatchCommand(CLI::App& app) {
  auto options = std::make_shared<WatchOptions>();
  options->url = kDefaultLcmUrl;
  auto* command = app.add_subcommand("watch", "tell at once when a process dies, until SIGINT or SIGTERM");
  command->add_option("--config", options->configuration, "the vehicle's YAML file")->required();
  command->add_option("--lcm-url", options->url, "where the messages are")->capture_default_str();
  command->callback([options] { runWatch(*options); });
}

void addRecordCommand(CLI::App& app) {
  auto options = std::make_shared<RecordOptions>();
  options->url = kDefaultLcmUrl;
  auto* command =
      app.add_subcommand("record", "write every message into split logs, until SIGINT or SIGTERM");
  command->add_option("--out", options->out, "folder for <date>_<time>.lcm.00, .01, ...")
      ->capture_default_str();
  command->add_option("--split", options->split_mb, "MB, a new file begins behind so many")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--min-free", options->min_free_mb, "MB of the disk that are left to others: exit 3")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--lcm-url", options->url, "where the messages are")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str();
  command->callback([options] {
    if (!runRecord(*options)) throw CLI::RuntimeError(3);
  });
}

}  // namespace redbee
