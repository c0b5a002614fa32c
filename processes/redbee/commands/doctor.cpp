#include "processes/redbee/vehicle/doctor.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

const Command kDoctorCommand(
    CommandGroup::kVehicle, "doctor",
    "check whether the stack can run here, and print a fix for each failed check", [](CLI::App& command) {
      auto options = std::make_shared<DoctorOptions>();
      addLcmUrlOption(command, options->url);
      command.add_option("--camera", options->camera_channel, "channel of the images")->capture_default_str();
      command.add_option("--imu", options->imu_channel, "channel of the IMU samples")->capture_default_str();
      command.callback([options] {
        if (runDoctor(*options) > 0) throw CLI::RuntimeError(1);
      });
    });

}  // namespace
}  // namespace redbee
