#include "processes/redbee/evaluate/reference_extrinsics.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "redbee/geometry/angle.hpp"

namespace redbee {
namespace {

void setUp(CLI::App& command) {
  auto options = std::make_shared<ReferenceExtrinsicsOptions>();
  command.add_option("--flight", options->flight, "folder with groundtruth.yaml and labels")->required();
  addConfigurationOption(command, options->configuration);
  addOutOption(command, options->out, "configuration to write, YAML; it includes that of the vehicle");
  command.add_option("--seed", options->seed, "any text; by default the name of the flight's folder");
  auto degrees = std::make_shared<double>(options->disturbance.rotation_rad / kDegree);
  auto milliseconds = std::make_shared<double>(1e3 * options->disturbance.timeshift_s);
  command.add_option("--rotation-deg", *degrees, "rotation error about a random axis, degrees")
      ->check(numberFrom(0, 180))
      ->capture_default_str();
  command.add_option("--timeshift-ms", *milliseconds, "error of the time shift, early or late, ms")
      ->check(numberFrom(0, 1000))
      ->capture_default_str();
  command
      .add_option("--height-fraction", options->disturbance.height_fraction,
                  "error of the start height, up or down, as a fraction of it")
      ->check(numberFrom(0, 0.9))
      ->capture_default_str();
  command.callback([options, degrees, milliseconds] {
    options->disturbance.rotation_rad = *degrees * kDegree;
    options->disturbance.timeshift_s = 1e-3 * *milliseconds;
    writeReferenceExtrinsics(*options);
  });
}

const Command kReferenceExtrinsicsCommand(
    CommandGroup::kEvaluation, "reference-extrinsics",
    "write a configuration with a rendered clip's true extrinsics plus the error a calibration would leave",
    setUp);

}  // namespace
}  // namespace redbee
