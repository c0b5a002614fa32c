// The filter under a gimbal that holds the camera level while the body turns briskly: exact homographies,
// with pixel noise, are fed back, and the filter's are compared with the exact ones.
#include <gtest/gtest.h>

#include <iostream>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/filter_errors.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 120;

simulation::Scenario gimbalFlight(double noise_deg) {
  simulation::Scenario scenario = simulation::gimbalWalkers(3);
  scenario.gimbal->errors = {};
  scenario.gimbal->errors.noise_sigma = noise_deg * kDegree;
  scenario.frames = kFrames;
  return scenario;
}

InertialParameters parametersOf(const simulation::Scenario& scenario, double noise_deg) {
  InertialParameters parameters = filterParameters(scenario);
  parameters.gimbal.enabled = true;
  parameters.gimbal.angle_sigma_deg = noise_deg;
  return parameters;
}

TEST(GimbalFilter, ExactAnglesGiveTheHomographyOfAFixedCamera) {
  const simulation::FlightSimulator flight(gimbalFlight(0));
  InertialFilter filter = filterOf(flight, parametersOf(flight.scenario(), 0.01));
  EXPECT_LT(errorsOf(flight, filter).px, 0.4);
}

TEST(GimbalFilter, TheNoiseOfTheAnglesIsPartOfTheCovariance) {
  for (const double noise_deg : {0.05, 0.2}) {
    const simulation::FlightSimulator flight(gimbalFlight(noise_deg));
    const FilterErrors errors =
        expectHonestCovariance(flight, parametersOf(flight.scenario(), noise_deg), noise_deg);
    EXPECT_GT(errors.px, 4 * noise_deg) << "f = 500 px";
  }
}

/// Mean transfer error of the ground's homography by the filter's rotation, all else exact, without vision.
double rotationError_px(const simulation::FlightSimulator& flight, bool is_used) {
  InertialParameters parameters = parametersOf(flight.scenario(), 0.05);
  parameters.gimbal.enabled = is_used;
  parameters.gyro_bias = flight.scenario().imu.gyro_bias;
  InertialFilter filter = filterOf(flight, parameters);
  double sum = 0;
  filter.advanceTo(flight.frameTime(0));
  for (int k = 1; k < kFrames; ++k) {
    PlaneMotion motion = flight.motion(k);
    motion.R_ba = filter.advanceTo(flight.frameTime(k)).motion.R_ba;
    const Eigen::Matrix3d H = planeHomography(flight.camera().K(), motion);
    sum += meanTransferError(H, flight.homography(k), kWidth, kHeight);
  }
  return sum / (kFrames - 1);
}

TEST(GimbalFilter, WithoutItsAnglesTheRotationIsTheBodys) {
  const simulation::FlightSimulator exact(gimbalFlight(0)), noisy(gimbalFlight(0.05));
  const simulation::FlightSimulator as_simulated(simulation::gimbalWalkers(3));
  const double used = rotationError_px(exact, true), ignored = rotationError_px(exact, false);
  std::cout << "rotation: exact angles " << used << " px, 0.05 deg of noise " << rotationError_px(noisy, true)
            << " px, with bias, noise and lag " << rotationError_px(as_simulated, true) << " px, ignored "
            << ignored << " px\n";
  EXPECT_LT(used, 0.2);
  EXPECT_GT(ignored, 20 * used);
}

TEST(GimbalFilter, AFrameWithoutAnAttitudeHasNoHomographyAndTheNextOnesHave) {
  const simulation::FlightSimulator flight(gimbalFlight(0));
  const ImuTime from = toImu(flight.frameTime(30), Duration(0)),
                to = toImu(flight.frameTime(40), Duration(0));
  InertialFilter filter =
      filterOf(flight, parametersOf(flight.scenario(), 0.01),
               [&](const MountSample& sample) { return sample.time < from || sample.time > to; });
  int missing = 0;
  for (int k = 0; k < 60; ++k) {
    const InertialHomography result = filter.advanceTo(flight.frameTime(k));
    if (k < 1) continue;
    const bool is_gap = k >= 30 && k <= 41;
    EXPECT_EQ(result.valid, !is_gap) << k;
    missing += result.status == InertialStatus::kNoMount ? 1 : 0;
    if (k == 50) {
      EXPECT_LT(meanTransferError(result.H, flight.homography(k), kWidth, kHeight), 12);
    }
  }
  EXPECT_EQ(missing, 12);
}

TEST(GimbalFilter, AWarmStartDoesNotDependOnWhereTheGimbalIs) {
  simulation::Scenario scenario = gimbalFlight(0);
  scenario.gimbal->yaw_pitch_roll[0] = {40 * kDegree, 0, {}};
  const simulation::FlightSimulator flight(scenario);
  const InertialParameters parameters = parametersOf(scenario, 0.01);
  InertialFilter filter = filterOf(flight, parameters);
  errorsOf(flight, filter);
  ASSERT_TRUE(filter.snapshot());
  const Eigen::Matrix3d& kept = filter.snapshot()->R_CI;
  EXPECT_LT(logSO3(kept * scenario.extrinsics.R_CI.transpose()).norm(), 1 * kDegree)
      << "the mounting at rest";

  InertialFilter restarted = filterOf(flight, parameters);
  restarted.advanceTo(flight.frameTime(kFrames));
  EXPECT_EQ(restarted.warmStart(*filter.snapshot()), SnapshotCheck::kAccepted);
  const InertialHomography result = restarted.advanceTo(flight.frameTime(kFrames + 1));
  ASSERT_TRUE(result.valid);
  EXPECT_LT(meanTransferError(result.H, flight.homography(kFrames + 1), kWidth, kHeight), 1.5);
}

}  // namespace
}  // namespace redbee::test
