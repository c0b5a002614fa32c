// Calibrations that find a rolling shutter, or a gyro with wrong axes.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/support/calibration_recording.hpp"

namespace redbee::calibration {
namespace {

using simulation::Trajectory;
using simulation::TrajectoryParameters;
using test::RecordingOptions;
using test::SimulatedRecording;
using test::simulateRecording;

RecordingOptions briefly() {
  RecordingOptions options;
  options.duration_s = 8;
  options.grid_px = 40;
  return options;
}

double rotationError_deg(const CalibrationResult& result, const SimulatedRecording& recording) {
  return logSO3(result.values.estimated.R_CI * recording.truth.R_CI.transpose()).norm() / kDegree;
}

TEST(Calibration, FindsTheLineDelayOfARollingShutter) {
  for (const double readout_s : {0.025, -0.012}) {
    RecordingOptions options = briefly();
    options.readout_s = readout_s;
    const SimulatedRecording r = simulateRecording(Trajectory::calibration(31, 6), 31, options);
    const CalibrationResult result = calibrate(r.input);
    const ParameterReport& report = result.parameter("camera.line_delay_s");
    const double truth_s = readout_s / r.input.camera.height;
    std::cout << "line delay " << 1e6 * result.values.line_delay_s << " us +- " << 1e6 * report.sigma[0]
              << ", true " << 1e6 * truth_s << "; R_CI off by " << rotationError_deg(result, r) << " deg\n";
    EXPECT_EQ(report.verdict, Verdict::kFound) << report.explanation;
    EXPECT_LT(std::abs(result.values.line_delay_s - truth_s), 4 * report.sigma[0] + 0.02 * std::abs(truth_s));
    EXPECT_LT(rotationError_deg(result, r), 0.1) << "as with a global shutter";
    EXPECT_LT(std::abs(result.values.estimated.timeshift_s - r.truth.timeshift_s), 0.0005);
  }
}

TEST(Calibration, TakesAGlobalShutterForOne) {
  const SimulatedRecording r = simulateRecording(Trajectory::calibration(32, 6), 32, briefly());
  const CalibrationResult result = calibrate(r.input);
  EXPECT_EQ(result.parameter("camera.line_delay_s").verdict, Verdict::kFound);
  EXPECT_EQ(result.values.line_delay_s, 0);
  EXPECT_EQ(result.parameter("imu.gyro_correction").verdict, Verdict::kFound);
  EXPECT_TRUE(result.values.gyro_correction.isIdentity(0));
}

TEST(Calibration, AHoverShowsNeitherLineDelayNorGyroAxes) {
  TrajectoryParameters p;
  p.position[2] = {6, 0, {}};
  RecordingOptions options = briefly();
  options.readout_s = 0.025;
  SimulatedRecording r = simulateRecording(Trajectory(p), 33, options);
  r.input.camera.line_delay_s = 3e-5;
  const CalibrationResult result = calibrate(r.input);
  for (const char* name : {"camera.line_delay_s", "imu.gyro_correction"}) {
    EXPECT_EQ(result.parameter(name).verdict, Verdict::kRefused)
        << name << ": " << result.parameter(name).explanation;
  }
  EXPECT_EQ(result.values.line_delay_s, 3e-5) << "the nominal one stays";
  EXPECT_TRUE(result.values.gyro_correction.isIdentity(0));
}

TEST(Calibration, FindsScaleAndMisalignmentOfTheGyro) {
  RecordingOptions options = briefly();
  Eigen::Matrix3d wrong;
  wrong << 1.02, 0.01, 0, 0.01, 0.985, -0.008, 0, -0.008, 1;
  options.gyro_axes = wrong;
  const SimulatedRecording r = simulateRecording(Trajectory::calibration(34, 6), 34, options);
  const CalibrationResult result = calibrate(r.input);
  const ParameterReport& report = result.parameter("imu.gyro_correction");
  const Eigen::Matrix3d left = result.values.gyro_correction * wrong - Eigen::Matrix3d::Identity();
  std::cout << "what is left of the gyro's error:\n" << left << "\nsigma " << report.worst_sigma << '\n';
  EXPECT_EQ(report.verdict, Verdict::kFound) << report.explanation;
  EXPECT_LT((0.5 * (left + left.transpose())).cwiseAbs().maxCoeff(), 0.002);
  EXPECT_LT(rotationError_deg(result, r), 0.15);
}

/// What counts is what the recording shows, not a fixed size.
TEST(Calibration, FindsASmallMisalignmentOfTheGyro) {
  RecordingOptions options = briefly();
  options.gyro_axes(0, 1) = options.gyro_axes(1, 0) = 0.004;
  const SimulatedRecording r = simulateRecording(Trajectory::calibration(35, 6), 35, options);
  const CalibrationResult result = calibrate(r.input);
  const ParameterReport& report = result.parameter("imu.gyro_correction");
  constexpr size_t kXy = 3;
  std::cout << "misalignment " << report.value[kXy] << " +- " << report.sigma[kXy] << '\n';
  EXPECT_NEAR(result.values.gyro_correction(0, 1), -0.004, 4 * report.sigma[kXy]);
  EXPECT_LT(report.sigma[kXy], 0.001);
}

TEST(Calibration, AnOrdinaryErrorOfTheFocalLengthIsNoneOfTheGyros) {
  SimulatedRecording r = simulateRecording(Trajectory::calibration(36, 6), 36, briefly());
  r.input.camera.fx *= 1.003;
  r.input.camera.fy *= 1.003;
  const CalibrationResult result = calibrate(r.input);
  EXPECT_TRUE(result.values.gyro_correction.isIdentity(0)) << result.values.gyro_correction;
}

}  // namespace
}  // namespace redbee::calibration
