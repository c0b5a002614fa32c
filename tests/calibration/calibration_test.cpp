// The complete calibration, compared with simulated truth.
#include "redbee/calibration/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "tests/support/calibration_recording.hpp"

namespace redbee::calibration {
namespace {

using simulation::Channel;
using simulation::Trajectory;
using simulation::TrajectoryParameters;
using test::RecordingOptions;
using test::SimulatedRecording;
using test::simulateRecording;

double rotationError_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return logSO3(a * b.transpose()).norm() / kDegree;
}

RecordingOptions briefly() {
  RecordingOptions options;
  options.duration_s = 6;
  options.grid_px = 40;
  return options;
}

/// Squared errors over squared deviations, added up over recordings.
struct Consistency {
  double sum = 0;
  int count = 0;
  void add(double error, double sigma) {
    sum += error * error / (sigma * sigma);
    ++count;
  }
  double rms() const { return std::sqrt(sum / count); }
};

/// REDBEE_CALIBRATION_SEEDS=50 in the environment runs more seeds; five take some seconds.
unsigned numberOfSeeds() {
  const char* number = std::getenv("REDBEE_CALIBRATION_SEEDS");
  return number != nullptr ? static_cast<unsigned>(std::max(1, std::atoi(number))) : 5U;
}

TEST(Calibration, SimulatedFlightsStayWithinTheLimitsAndTheirDeviations) {
  const unsigned seeds = numberOfSeeds();
  double worst_rotation = 0, worst_shift = 0, worst_height = 0;
  Consistency rotation, shift, height, gyro, accel;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    RecordingOptions options;
    options.duration_s = 8;
    options.grid_px = 40;
    options.outlier_ratio = 0.05;
    const SimulatedRecording r = simulateRecording(Trajectory::calibration(seed, 6), seed, options);
    const CalibrationResult result = calibrate(r.input);
    const InertialExtrinsics& estimated = result.values.estimated;
    worst_rotation = std::max(worst_rotation, rotationError_deg(estimated.R_CI, r.truth.R_CI));
    worst_shift = std::max(worst_shift, std::abs(estimated.timeshift_s - r.truth.timeshift_s));
    worst_height = std::max(worst_height, std::abs(estimated.start_height_m / r.truth.start_height_m - 1));
    const Eigen::Vector3d turn = logSO3(estimated.R_CI * r.truth.R_CI.transpose()) / kDegree;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<size_t>(i);
      rotation.add(turn(i), result.parameter("camera.R_CI").sigma[axis]);
      gyro.add((result.values.gyro_bias(i) - r.gyro_bias(i)) / kDegree,
               result.parameter("gyro_bias").sigma[axis]);
      accel.add(result.values.accel_bias(i) - r.accel_bias(i), result.parameter("accel_bias").sigma[axis]);
    }
    shift.add(estimated.timeshift_s - r.truth.timeshift_s, result.parameter("camera.timeshift_s").sigma[0]);
    height.add(estimated.start_height_m - r.truth.start_height_m,
               result.parameter("plane.height_m").sigma[0]);
  }
  std::cout << "worst of " << seeds << ": rotation " << worst_rotation << " deg, time shift "
            << 1e3 * worst_shift << " ms, height " << 100 * worst_height
            << " %\nrms of error / sigma: rotation " << rotation.rms() << ", time shift " << shift.rms()
            << ", height " << height.rms() << ", gyro bias " << gyro.rms() << ", accelerometer bias "
            << accel.rms() << "\n";
  EXPECT_LT(worst_rotation, 0.1);
  EXPECT_LT(worst_shift, 1e-3);
  EXPECT_LT(worst_height, 0.02);
  for (const Consistency* c : {&rotation, &shift, &height, &gyro, &accel}) {
    EXPECT_GT(c->rms(), 0.25);
    EXPECT_LT(c->rms(), 1.9);
  }
}

/// Errors common to all points of a quarter of the image do not average out; the residuals show them.
TEST(Calibration, DeviationsGrowWithErrorsThatNeighbouringPointsShare) {
  Consistency rotation;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    RecordingOptions options;
    options.duration_s = 8;
    options.grid_px = 40;
    options.common_noise_px = 0.1;
    const SimulatedRecording r = simulateRecording(Trajectory::calibration(seed, 6), seed, options);
    const CalibrationResult result = calibrate(r.input);
    const Eigen::Vector3d turn = logSO3(result.values.estimated.R_CI * r.truth.R_CI.transpose()) / kDegree;
    for (int i = 0; i < 3; ++i)
      rotation.add(turn(i), result.parameter("camera.R_CI").sigma[static_cast<size_t>(i)]);
  }
  std::cout << "rms of error / sigma with shared errors: " << rotation.rms() << "\n";
  EXPECT_LT(rotation.rms(), 1.6);
}

TEST(Calibration, ANominalMountingAQuarterTurnOffDoesNotMatter) {
  SimulatedRecording r = simulateRecording(Trajectory::calibration(11, 6), 11, briefly());
  r.input.nominal.R_CI = Eigen::Matrix3d::Identity();
  const CalibrationResult result = calibrate(r.input);
  EXPECT_LT(rotationError_deg(result.values.kept.R_CI, r.truth.R_CI), 0.1);
}

TEST(Calibration, NothingIsRefusedWhereEverythingMoves) {
  const SimulatedRecording r = simulateRecording(Trajectory::calibration(12, 6), 12, briefly());
  const CalibrationResult result = calibrate(r.input);
  for (const ParameterReport& report : result.parameters) {
    EXPECT_EQ(report.verdict, Verdict::kFound) << report.name << ": " << report.explanation;
  }
  ASSERT_EQ(result.split_half.size(), 4U);
  for (const SplitHalfEntry& entry : result.split_half) EXPECT_LT(entry.ratio(), 4) << entry.name;
}

TrajectoryParameters straightFlight(double speed) {
  TrajectoryParameters p;
  p.position[0] = {0, speed, {}};
  p.position[1] = {0, 0, {}};
  p.position[2] = {6, 0, {}};
  return p;
}

TEST(Calibration, HoverRefusesRotationTimeShiftAndHeight) {
  const SimulatedRecording r = simulateRecording(Trajectory(straightFlight(0)), 21, briefly());
  const CalibrationResult result = calibrate(r.input);
  for (const char* name : {"camera.timeshift_s", "plane.height_m", "camera.R_CI", "camera.p_IC"}) {
    EXPECT_EQ(result.parameter(name).verdict, Verdict::kRefused)
        << name << ": " << result.parameter(name).explanation;
  }
  EXPECT_EQ(result.values.kept.R_CI, r.input.nominal.R_CI);
  EXPECT_EQ(result.values.kept.timeshift_s, r.input.nominal.timeshift_s);
  EXPECT_EQ(result.values.kept.start_height_m, r.input.nominal.start_height_m);
}

TEST(Calibration, ConstantVelocityNeedsAMeasuredHeight) {
  SimulatedRecording blind = simulateRecording(Trajectory(straightFlight(1.5)), 22, briefly());
  EXPECT_EQ(calibrate(blind.input).parameter("plane.height_m").verdict, Verdict::kRefused);

  SimulatedRecording given = blind;
  given.input.start_height = MeasuredHeight{blind.truth.start_height_m, 0.05};
  EXPECT_EQ(calibrate(given.input).parameter("plane.height_m").verdict, Verdict::kFound);

  RecordingOptions options = briefly();
  options.altimeter = true;
  const SimulatedRecording measured = simulateRecording(Trajectory(straightFlight(1.5)), 22, options);
  const CalibrationResult result = calibrate(measured.input);
  EXPECT_EQ(result.parameter("plane.height_m").verdict, Verdict::kFound);
  EXPECT_NEAR(result.values.kept.start_height_m, measured.truth.start_height_m,
              0.02 * measured.truth.start_height_m);
}

TEST(Calibration, TurningAboutOneAxisDoesNotShowTheRotation) {
  TrajectoryParameters p = straightFlight(0);
  p.yaw_pitch_roll[0].sinusoids = {{0.4, 0.4, 0}, {0.1, 0.9, 1}};
  const SimulatedRecording r = simulateRecording(Trajectory(p), 23, briefly());
  const CalibrationResult result = calibrate(r.input);
  const ParameterReport& report = result.parameter("camera.R_CI");
  EXPECT_NE(report.verdict, Verdict::kFound) << report.explanation;
  EXPECT_LT(result.excitation.rotation(1), 0.1 * result.excitation.rotation(0));
}

TEST(Calibration, ATargetReplacesTheGround) {
  SimulatedRecording r = simulateRecording(Trajectory::calibration(31, 1.2), 31);
  r.input.ground.clear();
  const Trajectory trajectory = Trajectory::calibration(31, 1.2);
  const Camera camera(r.input.camera);
  std::mt19937 random(31);
  std::normal_distribution<double> noise(0, 0.1);
  for (const CameraTime frame : r.input.frames) {
    const double t = seconds(frame - r.input.frames.front()) + r.truth.timeshift_s;
    const simulation::TrajectoryState state = trajectory.at(t);
    const Eigen::Matrix3d R_CG = r.truth.R_CI * state.R_GI.transpose();
    const Eigen::Vector3d p_GC = state.p_GI + state.R_GI * r.truth.p_IC;
    TargetView view;
    view.time = frame;
    for (int i = 0; i < 64; ++i) {
      const int column = i % 8, row = i / 8;
      const Eigen::Vector3d corner(0.6 + 0.15 * column, 0.5 - 0.15 * row, 0);
      const Eigen::Vector3d X = R_CG * (corner - p_GC);
      if (X.z() <= 0.1) continue;
      const Eigen::Vector2d pixel = (camera.K() * X).hnormalized();
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > 639 || pixel.y() > 479) continue;
      view.pixels.emplace_back(pixel.x() + noise(random), pixel.y() + noise(random));
      view.corners.push_back(corner);
    }
    r.input.target.push_back(view);
  }
  const CalibrationResult result = calibrate(r.input);
  std::cout << "target: rotation off by " << rotationError_deg(result.values.kept.R_CI, r.truth.R_CI)
            << " deg, time shift by " << 1e3 * (result.values.kept.timeshift_s - r.truth.timeshift_s)
            << " ms\n";
  EXPECT_LT(rotationError_deg(result.values.kept.R_CI, r.truth.R_CI), 0.1);
  EXPECT_NEAR(result.values.kept.timeshift_s, r.truth.timeshift_s, 1e-3);
  EXPECT_EQ(result.parameter("plane.height_m").verdict, Verdict::kNotApplicable);
}

std::string complaintAbout(const CalibrationInput& input) {
  try {
    calibrate(input);
  } catch (const CalibrationError& error) {
    return error.what();
  }
  return "";
}

TEST(Calibration, ReportsWhyARecordingIsUnusable) {
  const SimulatedRecording whole = simulateRecording(Trajectory::calibration(1, 6), 1);
  CalibrationInput input = whole.input;
  input.imu.clear();
  EXPECT_EQ(complaintAbout(input), "there are no IMU samples");
  input = whole.input;
  input.frames.clear();
  EXPECT_EQ(complaintAbout(input), "there are no frames");
  input = whole.input;
  for (ImuSample& sample : input.imu) sample.time += std::chrono::minutes(1);
  EXPECT_THAT(complaintAbout(input), testing::HasSubstr("covers only 0 of 288 frames"));
  input = whole.input;
  for (GroundMatch& match : input.ground) match.points = {};
  EXPECT_THAT(complaintAbout(input), testing::HasSubstr("too little texture"));
}

}  // namespace
}  // namespace redbee::calibration
