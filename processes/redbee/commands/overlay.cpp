#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"

namespace redbee {
namespace {

const Command kOverlayCommand(CommandGroup::kFlights, "overlay",
                              "draw the results of a run over its flight, as a video", [](CLI::App& command) {
                                auto options = std::make_shared<OverlayOptions>();
                                addLogOption(command, options->log)->required();
                                addConfigurationOption(command, options->configuration);
                                addResultsOption(command, options->results);
                                addOutOption(command, options->video, "video to write, MP4");
                                command.add_option("--stills", options->stills,
                                                   "folder for some of the images, as PNG files");
                                command.callback([options] { renderOverlay(*options); });
                              });

}  // namespace
}  // namespace redbee
