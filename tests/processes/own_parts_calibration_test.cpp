// Calibration of a camera that sees its own drone: with camera.mask as good as one that does not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "tests/support/own_parts.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 192;
constexpr double kNominalOff_deg = 2;

struct CalibrationError {
  double rotation_deg = 0;
  double timeshift_ms = 0;
};

void writeLog(const StackFlight& flight, const std::filesystem::path& file) {
  LogWriter log(file);
  for (const SensorMessage& sent : flight.messages) log.write(sent.utime, sent.channel, sent.data);
  log.close();
}

/// By the program, from a vehicle whose rotation is wrong by two degrees and whose time shift is not known.
CalibrationError calibrated(const char* name, const StackFlight& flight, bool is_masked) {
  const ScratchFolder folder;
  const InertialExtrinsics& truth = flight.configuration.inertial.extrinsics;
  Configuration nominal = flight.configuration;
  nominal.inertial.extrinsics.R_CI =
      expSO3(Eigen::Vector3d(1, -1, 1).normalized() * kNominalOff_deg * kDegree) * truth.R_CI;
  nominal.inertial.extrinsics.timeshift_s = 0;
  std::string yaml = emitYaml(nominal);
  if (is_masked) {
    const std::string key = "  mask: \"\"";
    yaml.replace(yaml.find(key), key.size(), "  mask: \"parts.png\"");
    cv::imwrite((folder / "parts.png").string(), maskOfParts());
  }
  writeText(folder / "vehicle.yaml", yaml);
  writeLog(flight, folder / "flight.lcm");
  const std::string out = (folder / "calibration").string();
  const std::string command = std::string(REDBEE_BINARY_DIR "/bin/redbee-calibrate calibrate --log ") +
                              (folder / "flight.lcm").string() + " --config " +
                              (folder / "vehicle.yaml").string() + " --out " + out + " >" + out + ".txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << name;
  writeText(folder / "flown.yaml", "include: [vehicle.yaml, calibration/calibration.yaml]\n");
  const InertialExtrinsics found = loadConfiguration(folder / "flown.yaml").inertial.extrinsics;
  CalibrationError error;
  error.rotation_deg = logSO3(found.R_CI * truth.R_CI.transpose()).norm() / kDegree;
  error.timeshift_ms = std::abs(found.timeshift_s - truth.timeshift_s) * 1e3;
  std::cout << name << ": rotation off by " << error.rotation_deg << " deg, time shift by "
            << error.timeshift_ms << " ms\n";
  return error;
}

TEST(OwnPartsCalibration, WithTheMaskItIsAsWithoutTheParts) {
  simulation::Scenario scenario = simulation::calibrationFlight(2);
  const CalibrationError clear = calibrated("no parts in view", stackFlight(scenario, kFrames), false);
  const StackFlight flight = flightWithParts(scenario, kFrames);
  calibrated("parts in view, no mask", flight, false);
  const CalibrationError masked = calibrated("parts in view, masked", flight, true);
  EXPECT_LT(masked.rotation_deg, 2 * clear.rotation_deg + 0.05);
  EXPECT_LT(masked.timeshift_ms, 2 * clear.timeshift_ms + 0.3);
}

}  // namespace
}  // namespace redbee::test
