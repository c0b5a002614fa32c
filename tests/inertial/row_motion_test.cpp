// The filter's motion during the read-out of a rolling shutter, against the simulated drone's.
#include <gtest/gtest.h>

#include <iostream>

#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/noisy_homography.hpp"

namespace redbee::test {
namespace {

constexpr double kReadout_s = 0.025;

simulation::FlightSimulator flight() {
  return simulation::FlightSimulator(withRollingShutter(simulation::briskWalkers(5), kReadout_s));
}

InertialFilter filterFor(const simulation::FlightSimulator& flight) {
  InertialParameters parameters;
  parameters.extrinsics = flight.scenario().extrinsics;
  parameters.noise = flight.scenario().imu.noise;
  return {flight.camera(), parameters};
}

TEST(RowMotionOfTheFilter, TurnsTheRowsAsTheDroneTurns) {
  const simulation::FlightSimulator drone = flight();
  InertialFilter filter = filterFor(drone);
  for (const ImuSample& sample : drone.imu()) filter.addImu(sample);
  std::mt19937 random(7);
  double worst_rad = 0, worst_translation = 0, largest_rad = 0;
  for (int k = 0; k < 60; ++k) {
    const InertialHomography result = filter.advanceTo(drone.frameTime(k));
    ASSERT_TRUE(result.row_motion) << "also of the first frame";
    if (result.valid) {
      HomographyObservation seen = noisyHomography(drone.homography(k), 0.3, random);
      seen.time_previous = result.time_previous;
      seen.time = result.time;
      filter.correct(seen);
    }
    if (k < 24) continue;
    const double t_s = drone.exposureTime(k);
    const auto attitude = [&](double tau_s) { return drone.poseAt(t_s + tau_s).R_CG; };
    for (const double tau_s : {-kReadout_s / 2, -kReadout_s / 4, kReadout_s / 4, kReadout_s / 2}) {
      const Eigen::Matrix3d truth = attitude(tau_s) * attitude(0).transpose();
      worst_rad =
          std::max(worst_rad, logSO3(result.row_motion->rotationAfter(tau_s) * truth.transpose()).norm());
      largest_rad = std::max(largest_rad, logSO3(truth).norm());
    }
    const RowMotion truth = drone.rowMotion(k);
    worst_translation = std::max(worst_translation, (result.row_motion->velocity - truth.velocity).norm());
    EXPECT_LT((result.row_motion->normal - truth.normal).norm(), 0.05);
  }
  std::cout << "worst error of a row's rotation " << worst_rad << " of up to " << largest_rad
            << " rad; of the velocity over the height " << worst_translation << " 1/s\n";
  EXPECT_GT(largest_rad, 0.008);
  EXPECT_LT(worst_rad, 1e-4) << "a twentieth of a pixel";
  EXPECT_LT(worst_translation, 0.02);
}

TEST(RowMotionOfTheFilter, IsWaitedForUntilTheLastRow) {
  const simulation::FlightSimulator drone = flight();
  InertialFilter filter = filterFor(drone);
  const CameraTime frame = drone.frameTime(1);
  const ImuTime last_row = toImu(
      frame, fromSeconds(drone.scenario().extrinsics.timeshift_s + halfReadout(drone.camera().intrinsics())));
  std::optional<ImuTime> covered;
  for (const ImuSample& sample : drone.imu()) {
    filter.addImu(sample);
    if (!covered && filter.covers(frame)) covered = sample.time;
  }
  ASSERT_TRUE(covered);
  EXPECT_GE(*covered, last_row);
  EXPECT_LE(*covered, last_row + std::chrono::milliseconds(10)) << "a spike is told by the samples after it";
}

TEST(RowMotionOfTheFilter, AGlobalShutterHasNone) {
  const simulation::FlightSimulator drone(simulation::briskWalkers(5));
  InertialFilter filter = filterFor(drone);
  for (const ImuSample& sample : drone.imu()) filter.addImu(sample);
  filter.advanceTo(drone.frameTime(0));
  EXPECT_FALSE(filter.advanceTo(drone.frameTime(1)).row_motion);
}

TEST(RowMotionOfTheFilter, WithoutSamplesDuringTheReadoutThereIsNone) {
  const simulation::FlightSimulator drone = flight();
  InertialFilter filter = filterFor(drone);
  const ImuTime gap = toImu(drone.frameTime(3), fromSeconds(drone.scenario().extrinsics.timeshift_s));
  for (const ImuSample& sample : drone.imu()) {
    if (std::chrono::abs(sample.time - gap) > std::chrono::milliseconds(150)) filter.addImu(sample);
  }
  for (int k = 0; k < 3; ++k) filter.advanceTo(drone.frameTime(k));
  EXPECT_FALSE(filter.advanceTo(drone.frameTime(3)).row_motion);
}

}  // namespace
}  // namespace redbee::test
