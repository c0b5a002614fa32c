#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/mosaic/make_mosaic.hpp"

namespace redbee {
namespace {

const Command kMosaicCommand(
    CommandGroup::kFlights, "mosaic",
    "the ground of a flight as one image, and the tracks of what moved on it", [](CLI::App& command) {
      auto options = std::make_shared<MosaicOptions>();
      addLogOption(command, options->log)->required();
      addConfigurationOption(command, options->configuration);
      addOutOption(command, options->out,
                   "folder for mosaic.png, mosaic.tif, tracks.png, tracks.csv and summary.json");
      command.add_option("--size", options->most_px, "most pixels of a side")
          ->check(CLI::Range(16, 16384))
          ->capture_default_str();
      command.add_option("--every", options->every, "draw every n-th frame")
          ->check(CLI::Range(1, 1000000))
          ->capture_default_str();
      command.callback([options] {
        const MosaicSummary summary = makeMosaic(*options);
        std::printf("%lld frames in %s: %dx%d px of %.3g %s, %zu tracks\n",
                    static_cast<long long>(summary.frames), options->out.c_str(), summary.width,
                    summary.height, summary.units_per_px, summary.is_metric ? "m" : "px", summary.tracks);
        if (summary.epsg != 0) {
          std::printf("mosaic.tif: EPSG:%d, %.2f m (rms) from the poses\n", summary.epsg, summary.residual_m);
        } else {
          std::printf("no mosaic.tif: %s\n", summary.why_no_place.c_str());
        }
      });
    });

}  // namespace
}  // namespace redbee
