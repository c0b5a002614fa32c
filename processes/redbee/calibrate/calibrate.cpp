#include "processes/redbee/calibrate/calibrate.hpp"

#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "processes/redbee/calibrate/calibration_files.hpp"
#include "processes/redbee/calibrate/calibration_log.hpp"
#include "processes/redbee/calibrate/calibration_report.hpp"
#include "processes/redbee/calibrate/calibration_target_csv.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "processes/warnings.hpp"
#include "redbee/calibration/calibration.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/progress.hpp"

namespace redbee {
namespace {

using calibration::CalibrationInput;
using calibration::CalibrationResult;

/// Blocks signals while files are renamed, so that an interrupt leaves either all of them or none.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

void writeTogether(const std::filesystem::path& folder,
                   const std::vector<std::pair<std::string, std::string>>& contents) {
  const SignalsHeld held;
  std::filesystem::create_directories(folder);
  std::vector<std::unique_ptr<AtomicFile>> files;
  for (const auto& [name, text] : contents) {
    files.push_back(std::make_unique<AtomicFile>(folder / name));
    files.back()->write(text);
  }
  for (const auto& file : files) file->close();
}

CalibrationInput inputFrom(const Configuration& configuration) {
  CalibrationInput input;
  input.camera = configuration.camera;
  input.nominal = configuration.inertial.extrinsics;
  input.noise = configuration.inertial.noise;
  input.gravity = configuration.inertial.gravity;
  input.gyro_bias_sigma = configuration.inertial.gyro_bias_sigma;
  input.accel_bias_sigma = configuration.inertial.accel_bias_sigma;
  input.ransac = configuration.visual.ransac;
  return input;
}

std::string sourceOf(const CalibrateOptions& options) {
  return (options.log.empty() ? options.target_corners : options.log).string();
}

void readSource(const CalibrateOptions& options, const Configuration& configuration,
                CalibrationInput& input) {
  if (!options.log.empty()) {
    if (configuration.inertial.gimbal.enabled)
      printWarning("gimbal.enabled: the calibration takes a fixed camera; its gimbal must have been at rest");
    readCalibrationLog(options.log, configuration, options.quiet, input);
    if (options.no_altimeter) input.altimeter.clear();
    return;
  }
  if (options.target_corners.empty() || options.imu.empty()) {
    throw InputError("calibrate: give --log, or --target-corners with --imu");
  }
  input.target = readTargetCorners(options.target_corners);
  for (const auto& view : input.target) input.frames.push_back(view.time);
  input.imu = readTargetImu(options.imu);
}

void printVerdicts(const CalibrationResult& result) {
  for (const calibration::ParameterReport& report : result.parameters) {
    std::printf("%-19s %-14s %s\n", report.name.c_str(), toString(report.verdict),
                report.explanation.c_str());
  }
  printWarnings(result.warnings);
}

}  // namespace

int runCalibrate(const CalibrateOptions& options) {
  SvgPlot::checkInstalled();
  checkWritableFolder(options.out);
  const Configuration configuration = loadConfiguration(options.configuration);
  CalibrationInput input = inputFrom(configuration);
  readSource(options, configuration, input);
  if (options.height_m)
    input.start_height = calibration::MeasuredHeight{*options.height_m, options.height_sigma_m};

  CalibrationResult result;
  {
    Progress progress("calibrating", "frames", options.quiet);
    const auto frames = static_cast<int64_t>(input.frames.size());
    try {
      result = calibration::calibrate(input, [&](double fraction) {
        progress.update(static_cast<int64_t>(fraction * static_cast<double>(frames)), frames);
      });
    } catch (const calibration::CalibrationError& error) {
      throw InputError(sourceOf(options), error.what());
    }
  }
  const CalibrationSubject subject{configuration.vehicle, sourceOf(options)};
  writeTogether(options.out, {{"camchain-imucam.yaml", kalibrCamchain(input, result, subject)},
                              {"imu.yaml", kalibrImu(input, result, subject)},
                              {"calibration.yaml", onlineCalibration(input, result, subject)},
                              {"verdict.json", verdictJson(result, subject)},
                              {"report.html", calibrationReport(input, result, subject)}});
  printVerdicts(result);
  std::printf("results in %s\n", options.out.c_str());
  return 0;
}

}  // namespace redbee
