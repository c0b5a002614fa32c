#include "processes/redbee/calibrate/calibrate.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

void setUp(CLI::App& command) {
  auto options = std::make_shared<CalibrateOptions>();
  auto* log =
      addLogOption(command, options->log)
          ->description("flight over flat ground, half a minute with turns about all axes, an LCM log");
  auto* corners =
      command.add_option("--target-corners", options->target_corners,
                         "instead of a flight: corners of a target with 3-D points, CSV or CSV.gz");
  corners->excludes(log);
  command.add_option("--imu", options->imu, "IMU samples recorded with the corners, CSV")
      ->needs(corners)
      ->excludes(log);
  addConfigurationOption(command, options->configuration)
      ->description("configuration of the vehicle, a YAML file; its extrinsics are the nominal ones");
  addOutOption(command, options->out, "folder for the results");
  auto* height = command
                     .add_option("--height", options->height_m,
                                 "measured height of the camera above the ground at the first frame, m")
                     ->check(numberFrom(0.01, 20000));
  command.add_option("--height-sigma", options->height_sigma_m, "its standard deviation, m")
      ->check(numberFrom(1e-4, 1000))
      ->needs(height)
      ->capture_default_str();
  command.add_flag("--no-altimeter", options->no_altimeter, "ignore a recorded altimeter");
  command.callback([options] { runCalibrate(*options); });
}

const Command kCalibrateCommand(CommandGroup::kFlights, kCalibrateName, kCalibrateDescription, setUp);

}  // namespace
}  // namespace redbee
