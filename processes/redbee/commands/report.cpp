#include "processes/redbee/evaluate/report.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kReportCommand(CommandGroup::kFlights, "report",
                             "write one page of figures and images about a run", [](CLI::App& command) {
                               auto options = std::make_shared<ReportOptions>();
                               addLogOption(command, options->log)->required();
                               addConfigurationOption(command, options->configuration);
                               addResultsOption(command, options->results);
                               addOutOption(command, options->page, "page to write, HTML");
                               command.add_option("--truth", options->truth,
                                                  "folder of ground-truth masks, to measure the run against");
                               command.callback([options] { writeReport(*options); });
                             });

}  // namespace
}  // namespace redbee
