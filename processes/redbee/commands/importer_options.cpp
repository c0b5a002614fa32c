#include "processes/redbee/commands/importer_options.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/vehicle/import_flight.hpp"

namespace redbee {
namespace {

constexpr int kMostPixels = 16384;  ///< per side, of an image_t
constexpr double kLeastFps = 0.01;
constexpr double kMostFps = 10000;

void addUnitOption(CLI::App& command, const std::string& name, std::string& unit, const UnitTable& table) {
  command.add_option(name, unit, "of the IMU's samples")
      ->check(CLI::IsMember(namesOf(table)))
      ->capture_default_str();
}

void addTopicOptions(CLI::App& command, RosTopicChoice& topics) {
  command.add_option("--image-topic", topics.image, "topic of the images, where there are several");
  command.add_option("--imu-topic", topics.imu, "topic of the IMU; none: without");
  command.add_option("--range-topic", topics.range, "topic of the height above the ground; none: without");
  command.add_option("--camera-info-topic", topics.camera_info, "topic of the calibration; none: without");
}

}  // namespace

void addImporterOptions(CLI::App& command, ImportOptions& options, const ImporterTakes& takes) {
  if (takes.imu) {
    command.add_option(
        "--imu", options.imu,
        "IMU samples: what Sensor Logger, MARS Logger, OpenCamera Sensors or a logger of Gyroflow's "
        "(.gcsv) left, file or folder; or CSV with the columns t_s,gx,gy,gz,ax,ay,az in its first "
        "line (s since the start of the video, rad/s, m/s^2)");
    addUnitOption(command, "--time-unit", options.units.time, timeUnits());
  }
  if (takes.units) {
    addUnitOption(command, "--gyro-unit", options.units.gyro, gyroUnits());
    addUnitOption(command, "--accel-unit", options.units.accel, accelUnits());
  }
  if (takes.width) {
    command.add_option("--width", options.width, "width of the images at most, px; 0: as in the video")
        ->check(CLI::Range(0, kMostPixels))
        ->capture_default_str();
  }
  if (takes.fps)
    command.add_option("--fps", options.fps, "frames per second of a folder of images, or of a raw stream")
        ->check(numberFrom(kLeastFps, kMostFps));
  if (takes.keep_going)
    command.add_flag("--keep-going", options.keep_going, "pass over damage, up to the next key frame");
  if (takes.topics) addTopicOptions(command, options.topics);
  command.add_option("--camchain", options.camchain,
                     "the camera's calibration: Kalibr's camchain.yaml or camchain-imucam.yaml");
  command.add_option("--camera", options.camchain_camera, "the camera's section of the camchain")
      ->capture_default_str();
}

void setUpImporter(CLI::App& command, const Importer& importer) {
  auto options = std::make_shared<ImportOptions>(importer.defaults);
  command.add_option("source", options->source, importer.source)->required();
  if (importer.takes.chapters)
    command.add_option("further", options->further_sources, "the chapters that follow");
  addImporterOptions(command, *options, importer.takes);
  addOutOption(command, options->log, "log to write; the vehicle's configuration goes beside it");
  command.callback([options, importer] { printFlight(importFlight(importer, *options), options->log); });
}

}  // namespace redbee
