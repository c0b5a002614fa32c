#include "redbee/inertial/inertial_filter.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "redbee/geometry/chi_square.hpp"
#include "tests/support/filtered_flight.hpp"

namespace redbee::test {
namespace {

TEST(InertialFilter, RotationOverOneSecondWithKnownBiases) {
  double worst_deg = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const ConsumerImu imu(seed);
    const FilteredFlight flight(seed, 8, imu);
    InertialParameters parameters = flight.parameters();
    parameters.gyro_bias = imu.gyro_bias;
    parameters.accel_bias = imu.accel_bias;
    parameters.gyro_bias_sigma = 0;
    parameters.accel_bias_sigma = 0;
    parameters.extrinsic_rotation_sigma_deg = 0;
    InertialFilter filter = flight.filter(parameters);
    filter.advanceTo(frameTime(0));
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (int k = 1; k <= 24; ++k) R = filter.advanceTo(frameTime(k)).motion.R_ba * R;
    const Eigen::Matrix3d exact = flight.motion(frameTime(0), frameTime(24)).R_ba;
    worst_deg = std::max(worst_deg, logSO3(R * exact.transpose()).norm() * 180 / M_PI);
  }
  std::cout << "rotation over 1 s, worst of 5 flights: " << worst_deg << " deg\n";
  RecordProperty("rotation_error_deg", std::to_string(worst_deg));
  EXPECT_LT(worst_deg, 0.02);
}

TEST(InertialFilter, HomographyFedBackStaysBelowThreeTenthsOfAPixel) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const double height = 4.0 + 3 * seed;
    const FilteredFlight flight(seed, height, ConsumerImu(seed));
    InertialFilter filter = flight.filter(flight.parameters());
    const double error = flight.errorFedBack(filter, 180, 24);
    std::cout << "height " << height << " m: mean transfer error " << error << " px\n";
    RecordProperty("transfer_error_px_" + std::to_string(seed), std::to_string(error));
    EXPECT_LT(error, 0.3);
  }
}

TEST(InertialFilter, CovarianceOfTheHomographyIsConsistent) {
  constexpr int kRuns = 60;
  constexpr int kFrames = 48;
  double sum = 0;
  for (unsigned run = 1; run <= kRuns; ++run) {
    std::mt19937 random(run);
    ConsumerImu imu(run);
    imu.gyro_bias = randomVector(random, 0.01);
    imu.accel_bias = randomVector(random, 0.15);
    FilteredFlight flight(run, 8, imu);
    InertialParameters parameters = flight.parameters();
    const double mounting = parameters.extrinsic_rotation_sigma_deg * M_PI / 180;
    parameters.extrinsics.R_CI = expSO3(randomVector(random, mounting)) * parameters.extrinsics.R_CI;
    parameters.extrinsics.start_height_sigma_m = 0.5;
    parameters.extrinsics.start_height_m += randomVector(random, 0.5).x();
    InertialFilter filter = flight.filter(parameters);
    for (int k = 0; k <= kFrames; ++k) {
      const InertialHomography result = filter.advanceTo(frameTime(k));
      if (!result.valid) continue;
      if (k == kFrames) {
        sum += normalisedErrorSquared(result.H, result.covariance,
                                      flight.homography(result.time_previous, result.time));
      }
      filter.correct(flight.observe(result, random));
    }
  }
  const double low = chiSquareQuantile(0.025, 8 * kRuns) / kRuns;
  const double high = chiSquareQuantile(0.975, 8 * kRuns) / kRuns;
  std::cout << "NEES " << sum / kRuns << ", 95 % band " << low << " to " << high << '\n';
  RecordProperty("nees", std::to_string(sum / kRuns));
  EXPECT_GT(sum / kRuns, low);
  EXPECT_LT(sum / kRuns, high);
}

TEST(InertialFilter, WithoutFeedbackTheCovarianceGrows) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  std::mt19937 random(3);
  double held = 0;
  double drifted = 0;
  for (int k = 0; k <= 120; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (result.valid && k <= 60) filter.correct(flight.observe(result, random));
    if (k == 60) held = result.covariance.trace();
    if (k == 120) drifted = result.covariance.trace();
  }
  EXPECT_GT(drifted, 4 * held);
}

TEST(InertialFilter, HeightConvergesWithTheAltimeter) {
  const FilteredFlight flight(2, 8, ConsumerImu(2));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m = 2.0;  // six sigma off: refused at first, then accepted
  InertialFilter filter = flight.filter(parameters);
  for (const AltitudeSample& a : flight.altimeter(0, 6, 5)) {
    EXPECT_TRUE(filter.addAltitude(a));
  }
  InertialHomography result;
  std::mt19937 random(3);
  for (int k = 0; k <= 120; ++k) {
    result = filter.advanceTo(frameTime(k));
    if (result.valid) filter.correct(flight.observe(result, random));
  }
  const double truth = flight.motion(frameTime(120), frameTime(121)).h_a;
  std::cout << "height error " << std::abs(result.height_m - truth) << " m, sigma " << result.height_sigma_m
            << " m\n";
  EXPECT_NEAR(result.height_m, truth, 0.1);
  EXPECT_LT(result.height_sigma_m, 0.05);
}

TEST(InertialFilter, LateAltitudesStillCount) {
  const FilteredFlight flight(2, 8, ConsumerImu(2));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m += 1.0;
  InertialFilter filter = flight.filter(parameters);
  const auto altitudes = flight.altimeter(0, 6, 5);
  std::size_t next = 0;
  InertialHomography result;
  for (int k = 0; k <= 72; ++k) {
    while (altitudes[next].time < toImu(frameTime(k), -std::chrono::milliseconds(60)))
      filter.addAltitude(altitudes[next++]);
    result = filter.advanceTo(frameTime(k));
  }
  EXPECT_NEAR(result.height_m, flight.motion(frameTime(72), frameTime(73)).h_a, 0.2);
}

TEST(InertialFilter, RejectedVisionIsEventuallyAccepted) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialParameters parameters = flight.parameters();
  parameters.start_velocity_sigma = 0.05;  // and yet the drone flies at more than a metre a second
  InertialFilter filter = flight.filter(parameters);
  EXPECT_LT(flight.errorFedBack(filter, 180, 120), 0.3);
}

TEST(InertialFilter, ACorrectionCountsOnceAndOnlyForTheLastTwoFrames) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  filter.advanceTo(frameTime(0));
  std::mt19937 random(1);
  const HomographyObservation first = flight.observe(filter.advanceTo(frameTime(1)), random);
  EXPECT_TRUE(filter.correct(first).applied);
  EXPECT_FALSE(filter.correct(first).applied);
  filter.advanceTo(frameTime(2));
  EXPECT_FALSE(filter.correct(first).applied);
}

TEST(InertialFilter, APerfectImuGivesTheExactRotation) {
  const FilteredFlight flight(3, 8, PerfectImu());
  InertialFilter filter = flight.filter(flight.parameters());
  filter.advanceTo(frameTime(0));
  const InertialHomography result = filter.advanceTo(frameTime(1));
  const Eigen::Matrix3d exact = flight.motion(frameTime(0), frameTime(1)).R_ba;
  EXPECT_LT(logSO3(result.motion.R_ba * exact.transpose()).norm(), 1e-6);
}

}  // namespace
}  // namespace redbee::test
