// redbee export KIND: a flight for other tools.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/export_targets.hpp"
#include "processes/redbee/export/export_mcap.hpp"
#include "processes/warnings.hpp"
#include "redbee/files/printable.hpp"

namespace redbee {
namespace {

void runExportMcap(const McapExport& options) {
  const McapExported exported = exportMcap(options);
  printWarnings(exported.warnings);
  printDamaged(exported.damaged);
  std::vector<std::string> left_out;
  for (const auto& [channel, count] : exported.left_out)
    left_out.push_back(channel + " (" + std::to_string(count) + ")");
  if (!left_out.empty()) printWarning("not exported: " + firstTenOf(left_out));
  for (const auto& [topic, count] : exported.messages)
    std::printf("%s: %lld messages\n", printable(topic).c_str(), static_cast<long long>(count));
}

void addMcap(CLI::App& command) {
  auto options = std::make_shared<McapExport>();
  addLogOption(command, options->log)->required();
  command.add_option("--results", options->results, "results of detect or collect: their boxes");
  command.add_option("--config", options->configuration,
                     "configuration of the vehicle: its camera as camera_info");
  addOutOption(command, options->out, "MCAP file to write");
  command.callback([options] { runExportMcap(*options); });
}

const Command kExportCommand(CommandGroup::kFlights, "export",
                             "write a flight for other tools: Foxglove, ROS 2, maps", [](CLI::App& command) {
                               command.require_subcommand(1);
                               addMcap(*command.add_subcommand(
                                   "mcap", "MCAP: images, boxes, masks, IMU, altimeter, health, log"));
                               addTargetExports(command);
                             });

}  // namespace
}  // namespace redbee
