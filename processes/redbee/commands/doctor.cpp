#include "processes/redbee/vehicle/doctor.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"

namespace redbee {
namespace {

struct Options {
  bool live = false;
  DoctorOptions machine;
  LiveDoctorOptions stack;
};

int run(Options options) {
  options.stack.url = options.machine.url;
  return options.live ? runLiveDoctor(options.stack) : runDoctor(options.machine);
}

const Command kDoctorCommand(
    CommandGroup::kVehicle, "doctor",
    "check whether the stack can run here, and print a fix for each failed check; --live: the running stack, "
    "before a flight",
    [](CLI::App& command) {
      auto options = std::make_shared<Options>();
      addLcmUrlOption(command, options->machine.url);
      auto* camera = command.add_option("--camera", options->machine.camera_channel, "channel of the images")
                         ->capture_default_str();
      auto* imu = command.add_option("--imu", options->machine.imu_channel, "channel of the IMU samples")
                      ->capture_default_str();
      auto* live = command.add_flag(
          "--live", options->live,
          "listen to the running stack: rates, exposure, sharpness, time shift, IMU noise, processes, disk");
      live->excludes(camera)->excludes(imu);
      live->needs(
          addConfigurationOption(command, options->stack.configuration)->required(false)->needs(live));
      command.add_option("--seconds", options->stack.listen_s, "with --live: how long to listen")
          ->check(numberFrom(0.1, 3600))
          ->needs(live)
          ->capture_default_str();
      command
          .add_option("--recordings", options->stack.recordings,
                      "with --live: the folder of recordings, whose disk is looked at")
          ->needs(live)
          ->capture_default_str();
      command.callback([options] {
        if (run(*options) > 0) throw CLI::RuntimeError(1);
      });
    });

}  // namespace
}  // namespace redbee
