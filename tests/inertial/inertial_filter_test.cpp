#include "redbee/inertial/inertial_filter.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "redbee/geometry/chi_square.hpp"
#include "tests/inertial/simulated_flight.hpp"

namespace redbee {
namespace {

using namespace testing;
using simulation::ImuSimulatorParameters;
using simulation::Trajectory;

struct Flight {
  Flight(unsigned seed, double height_m, const ImuSimulatorParameters& imu_parameters)
      : trajectory(Trajectory::ordinary(seed, height_m)), extrinsics(testExtrinsics(height_m)) {
    imu = simulation::simulateImu(trajectory, -0.5, 8.0, kStart, imu_parameters);
    extrinsics.start_height_m = simulation::exactMotion(trajectory, extrinsics, 0, 0.01).h_a;
  }
  PlaneMotion motion(int64_t a, int64_t b) const {
    return simulation::exactMotion(trajectory, extrinsics, trajectoryTime(a, extrinsics),
                                   trajectoryTime(b, extrinsics));
  }
  Eigen::Matrix3d homography(int64_t a, int64_t b) const {
    return planeHomography(testCamera().K(), motion(a, b));
  }
  InertialParameters parameters() const {
    InertialParameters p;
    p.extrinsics = extrinsics;
    p.noise = consumerNoise();
    p.start_velocity_sigma = 2;
    p.feedback_correlation_frames = 1;  // the simulated corrections err independently
    return p;
  }

  Trajectory trajectory;
  InertialExtrinsics extrinsics;
  std::vector<ImuSample> imu;
};

ImuSimulatorParameters perfectImu() {
  ImuSimulatorParameters p;
  p.noise = {0, 0, 0, 0};
  return p;
}

ImuSimulatorParameters consumerImu(unsigned seed) {
  ImuSimulatorParameters p;
  p.noise = consumerNoise();
  p.gyro_bias = Eigen::Vector3d(0.5, -0.7, 0.5).normalized() * 0.4 * M_PI / 180;
  p.accel_bias = Eigen::Vector3d(0.6, 0.5, -0.6).normalized() * 0.1;
  p.seed = seed;
  return p;
}

InertialFilter filterWith(const Flight& flight, const InertialParameters& parameters) {
  InertialFilter filter(testCamera(), parameters);
  for (const ImuSample& sample : flight.imu) filter.addImu(sample);
  return filter;
}

HomographyObservation observe(const Flight& flight, const InertialHomography& result, std::mt19937& random) {
  HomographyObservation z =
      noisyHomography(flight.homography(result.utime_previous, result.utime), 0.3, random);
  z.utime_previous = result.utime_previous;
  z.utime = result.utime;
  return z;
}

double transferError(const Flight& flight, const InertialHomography& result) {
  return meanTransferError(result.H, flight.homography(result.utime_previous, result.utime), kWidth, kHeight);
}

/// Mean transfer error over frames [measure_from, frames), fed back.
double runFedBack(const Flight& flight, InertialFilter& filter, int frames, int measure_from) {
  std::mt19937 random(7);
  double sum = 0;
  for (int k = 0; k < frames; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (!result.valid) continue;
    if (k >= measure_from) sum += transferError(flight, result);
    filter.correct(observe(flight, result, random));
  }
  return sum / (frames - measure_from);
}

TEST(InertialFilter, RotationOverOneSecondWithKnownBiases) {
  double worst_deg = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    ImuSimulatorParameters imu = consumerImu(seed);
    const Flight flight(seed, 8, imu);
    InertialParameters parameters = flight.parameters();
    parameters.gyro_bias = imu.gyro_bias;
    parameters.accel_bias = imu.accel_bias;
    parameters.gyro_bias_sigma = 0;
    parameters.accel_bias_sigma = 0;
    parameters.extrinsic_rotation_sigma_deg = 0;
    InertialFilter filter = filterWith(flight, parameters);
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
    const Flight flight(seed, height, consumerImu(seed));
    InertialFilter filter = filterWith(flight, flight.parameters());
    const double error = runFedBack(flight, filter, 180, 24);
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
    ImuSimulatorParameters imu = consumerImu(run);
    imu.gyro_bias = randomVector(random, 0.01);
    imu.accel_bias = randomVector(random, 0.15);
    Flight flight(run, 8, imu);
    InertialParameters parameters = flight.parameters();
    const double mounting = parameters.extrinsic_rotation_sigma_deg * M_PI / 180;
    parameters.extrinsics.R_CI = expSO3(randomVector(random, mounting)) * parameters.extrinsics.R_CI;
    parameters.extrinsics.start_height_sigma_m = 0.5;
    parameters.extrinsics.start_height_m += randomVector(random, 0.5).x();
    InertialFilter filter = filterWith(flight, parameters);
    for (int k = 0; k <= kFrames; ++k) {
      const InertialHomography result = filter.advanceTo(frameTime(k));
      if (!result.valid) continue;
      if (k == kFrames) {
        sum += normalisedErrorSquared(result.H, result.covariance,
                                      flight.homography(result.utime_previous, result.utime));
      }
      filter.correct(observe(flight, result, random));
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
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter = filterWith(flight, flight.parameters());
  std::mt19937 random(3);
  double held = 0;
  double drifted = 0;
  for (int k = 0; k <= 120; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (result.valid && k <= 60) filter.correct(observe(flight, result, random));
    if (k == 60) held = result.covariance.trace();
    if (k == 120) drifted = result.covariance.trace();
  }
  EXPECT_GT(drifted, 4 * held);
}

TEST(InertialFilter, HeightConvergesWithTheAltimeter) {
  const Flight flight(2, 8, consumerImu(2));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m = 2.0;  // six sigma off: refused at first, then believed
  InertialFilter filter = filterWith(flight, parameters);
  for (const AltitudeSample& a :
       simulation::simulateAltimeter(flight.trajectory, flight.extrinsics, 0, 6, kStart, 50, 0.05, 5)) {
    EXPECT_TRUE(filter.addAltitude(a));
  }
  InertialHomography result;
  std::mt19937 random(3);
  for (int k = 0; k <= 120; ++k) {
    result = filter.advanceTo(frameTime(k));
    if (result.valid) filter.correct(observe(flight, result, random));
  }
  const double truth = flight.motion(frameTime(120), frameTime(121)).h_a;
  std::cout << "height error " << std::abs(result.height_m - truth) << " m, sigma " << result.height_sigma_m
            << " m\n";
  EXPECT_NEAR(result.height_m, truth, 0.1);
  EXPECT_LT(result.height_sigma_m, 0.05);
}

TEST(InertialFilter, LateAltitudesStillCount) {
  const Flight flight(2, 8, consumerImu(2));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m += 1.0;
  InertialFilter filter = filterWith(flight, parameters);
  const auto altitudes =
      simulation::simulateAltimeter(flight.trajectory, flight.extrinsics, 0, 6, kStart, 50, 0.05, 5);
  std::size_t next = 0;
  InertialHomography result;
  for (int k = 0; k <= 72; ++k) {
    while (altitudes[next].utime < frameTime(k) - 60'000) filter.addAltitude(altitudes[next++]);
    result = filter.advanceTo(frameTime(k));
  }
  EXPECT_NEAR(result.height_m, flight.motion(frameTime(72), frameTime(73)).h_a, 0.2);
}

TEST(InertialFilter, RefusedVisionIsBelievedAgainInTheEnd) {
  const Flight flight(1, 8, consumerImu(1));
  InertialParameters parameters = flight.parameters();
  parameters.start_velocity_sigma = 0.05;  // and yet the drone flies at more than a metre a second
  InertialFilter filter = filterWith(flight, parameters);
  EXPECT_LT(runFedBack(flight, filter, 180, 120), 0.3);
}

TEST(InertialFilter, ACorrectionCountsOnceAndOnlyForTheLastTwoFrames) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter = filterWith(flight, flight.parameters());
  filter.advanceTo(frameTime(0));
  std::mt19937 random(1);
  const HomographyObservation first = observe(flight, filter.advanceTo(frameTime(1)), random);
  EXPECT_TRUE(filter.correct(first).applied);
  EXPECT_FALSE(filter.correct(first).applied);
  filter.advanceTo(frameTime(2));
  EXPECT_FALSE(filter.correct(first).applied);
}

TEST(InertialFilter, LateAndRepeatedSamplesChangeNothing) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter straight = filterWith(flight, flight.parameters());
  InertialFilter shuffled(testCamera(), flight.parameters());
  for (std::size_t i = 0; i + 1 < flight.imu.size(); i += 2) {
    shuffled.addImu(flight.imu[i + 1]);
    shuffled.addImu(flight.imu[i]);
    shuffled.addImu(flight.imu[i + 1]);
  }
  for (int k = 0; k < 24; ++k) {
    EXPECT_EQ(straight.advanceTo(frameTime(k)).H, shuffled.advanceTo(frameTime(k)).H);
  }
}

TEST(InertialFilter, AHoleInTheImuIsBridgedWithAGrownCovariance) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter(testCamera(), flight.parameters());
  const int64_t begin = kStart + 1'020'000;
  for (const ImuSample& s : flight.imu) {
    if (s.utime < begin || s.utime > begin + 150'000) filter.addImu(s);
  }
  InertialHomography before;
  InertialHomography bridged;
  for (int k = 0; k <= 30; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (k == 24) before = result;
    if (k == 28) bridged = result;
    if (k == 30) {
      EXPECT_EQ(result.status, InertialStatus::kGood);
    }
  }
  EXPECT_EQ(before.status, InertialStatus::kGood);
  EXPECT_EQ(bridged.status, InertialStatus::kImuGap);
  EXPECT_TRUE(bridged.valid);
  EXPECT_GT(bridged.rotation_covariance.trace(), 10 * before.rotation_covariance.trace());
}

TEST(InertialFilter, ALostImuIsSaidAndItsReturnTakenUp) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter(testCamera(), flight.parameters());
  std::size_t next = 0;
  std::mt19937 random(2);
  double error = 0;
  for (int k = 0; k <= 144; ++k) {
    const bool lost = k >= 24 && k < 48;
    while (next < flight.imu.size() && flight.imu[next].utime <= frameTime(k) + 10'000) {
      if (!lost) filter.addImu(flight.imu[next]);
      ++next;
    }
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (lost && k > 25) {
      EXPECT_EQ(result.status, InertialStatus::kNoImu) << k;
    }
    if (lost && k > 25) {
      EXPECT_FALSE(result.valid);
    }
    if (result.valid) filter.correct(observe(flight, result, random));
    if (k > 120) error += transferError(flight, result) / 24;
  }
  EXPECT_LT(error, 0.3);
}

TEST(InertialFilter, TheHeightOutlivesAnOutage) {
  const Flight flight(1, 8, consumerImu(1));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m *= 0.6;
  parameters.extrinsics.start_height_sigma_m = 3;
  InertialFilter filter(testCamera(), parameters);
  const auto altitudes =
      simulation::simulateAltimeter(flight.trajectory, flight.extrinsics, 0, 4, kStart, 50, 0.05, 5);
  std::size_t next = 0;
  std::size_t next_altitude = 0;
  int started_anew = 0;
  InertialHomography result;
  for (int k = 0; k <= 130; ++k) {
    const bool lost = k >= 96 && k < 120;
    while (next < flight.imu.size() && flight.imu[next].utime <= frameTime(k) + 10'000) {
      if (!lost) filter.addImu(flight.imu[next]);
      ++next;
    }
    while (next_altitude < altitudes.size() && altitudes[next_altitude].utime <= frameTime(k)) {
      filter.addAltitude(altitudes[next_altitude++]);
    }
    result = filter.advanceTo(frameTime(k));
    started_anew += k > 0 && result.status == InertialStatus::kInitialising ? 1 : 0;
  }
  EXPECT_EQ(started_anew, 1);
  const double truth = flight.motion(frameTime(130), frameTime(131)).h_a;
  EXPECT_NEAR(result.height_m, truth, 3 * result.height_sigma_m);
  EXPECT_LT(result.height_m / truth, 1.3);
  EXPECT_GT(result.height_m / truth, 0.7) << "it began again at the configured height";
}

TEST(InertialFilter, ClocksThatJumpStartItAnew) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter = filterWith(flight, flight.parameters());
  for (int k = 0; k < 30; ++k) filter.advanceTo(frameTime(k));
  EXPECT_EQ(filter.advanceTo(frameTime(29)).status, InertialStatus::kClockJump);  // repeated: nothing moves
  EXPECT_TRUE(filter.advanceTo(frameTime(30)).valid);
  EXPECT_EQ(filter.advanceTo(frameTime(20)).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(21)).valid);
  EXPECT_EQ(filter.advanceTo(frameTime(21 + 24 * 3)).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(22 + 24 * 3)).valid);
  for (const int64_t absurd : {std::numeric_limits<int64_t>::min(), std::numeric_limits<int64_t>::max()}) {
    EXPECT_EQ(filter.advanceTo(absurd).status, InertialStatus::kClockJump);
  }
}

TEST(InertialFilter, BothClocksSetBackTogetherAreFollowed) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter = filterWith(flight, flight.parameters());
  for (int k = 0; k < 30; ++k) filter.advanceTo(frameTime(k));
  constexpr int64_t kBack = 500'000'000;
  for (ImuSample s : flight.imu) {
    s.utime -= kBack;
    filter.addImu(s);
  }
  EXPECT_EQ(filter.advanceTo(frameTime(30) - kBack).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(31) - kBack).valid);
}

TEST(InertialFilter, DamagedSamplesAreRefused) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter = filterWith(flight, flight.parameters());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(filter.addImu({kStart, Eigen::Vector3d::Constant(nan), Eigen::Vector3d::Zero()}));
  EXPECT_FALSE(filter.addAltitude({kStart, nan, 0.1}));
  EXPECT_FALSE(filter.addAltitude({kStart, 3.0, 0.0}));
  EXPECT_FALSE(
      filter.addImu({std::numeric_limits<int64_t>::min(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}));
  filter.advanceTo(frameTime(0));
  EXPECT_TRUE(filter.advanceTo(frameTime(1)).H.allFinite());
}

TEST(InertialFilter, AbsurdButFiniteSamplesNeverPublishNaN) {
  const Flight flight(1, 8, consumerImu(1));
  InertialFilter filter(testCamera(), flight.parameters());
  for (ImuSample s : flight.imu) {
    if (s.utime > frameTime(10) && s.utime < frameTime(11)) s.accel *= 1e200;
    filter.addImu(s);
  }
  for (int k = 0; k < 40; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    EXPECT_TRUE(result.H.allFinite() && result.covariance.allFinite()) << k;
    if (k > 24) {
      EXPECT_TRUE(result.valid) << k;
    }
  }
}

TEST(InertialFilter, WithoutImuThereIsNoHomography) {
  InertialFilter filter(testCamera(), InertialParameters());
  EXPECT_FALSE(filter.covers(frameTime(0)));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(filter.advanceTo(frameTime(k)).status, InertialStatus::kNoImu);
  EXPECT_FALSE(filter.state().has_value());
}

TEST(InertialFilter, APerfectImuGivesTheExactRotation) {
  const Flight flight(3, 8, perfectImu());
  InertialFilter filter = filterWith(flight, flight.parameters());
  filter.advanceTo(frameTime(0));
  const InertialHomography result = filter.advanceTo(frameTime(1));
  const Eigen::Matrix3d exact = flight.motion(frameTime(0), frameTime(1)).R_ba;
  EXPECT_LT(logSO3(result.motion.R_ba * exact.transpose()).norm(), 1e-6);
}

}  // namespace
}  // namespace redbee
