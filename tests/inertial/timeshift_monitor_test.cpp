// The time shift of a simulated flight, by its exact rotations with vision's noise and a consumer's gyro.
#include "redbee/inertial/timeshift_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {
namespace {

constexpr double kNoise_rad = 3e-4;  // a sixth of a pixel at 500 px
constexpr double kHeight_m = 8;

/// s by which the camera's stamps are late at a time [s] of the flight.
using Lateness = std::function<double(double t_s)>;
Lateness constant(double late_s) {
  return [=](double) { return late_s; };
}

struct FlightOptions {
  double duration_s = 30;
  Eigen::Vector3d mounting_error = Eigen::Vector3d::Zero();  ///< rad
  double outlier_fraction = 0;
  unsigned seed = 1;
};

simulation::Trajectory hovering() {
  simulation::TrajectoryParameters still;
  still.position[2].offset = kHeight_m;
  return simulation::Trajectory(still);
}

/// Feeds a monitor with a flight whose camera stamps are late.
void fly(TimeshiftMonitor& monitor, const simulation::Trajectory& trajectory, const Lateness& lateness,
         const FlightOptions& options = {}) {
  const SimulatedFlight flight(trajectory, mountedCamera(kHeight_m), kStart);
  const auto imu = flight.imu(ConsumerImu(options.seed), options.duration_s + 0.5);
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<double> uniform;
  const Eigen::Matrix3d mounting = expSO3(options.mounting_error);
  size_t next = 0;
  for (int k = 1; k < options.duration_s * kFrameRate; ++k) {
    const CameraTime a = frameTime(k - 1), b = frameTime(k);
    const ImuTime until = toImu(b, std::chrono::milliseconds(300));
    for (; next < imu.size() && imu[next].time <= until; ++next) {
      monitor.addGyro(imu[next].time, imu[next].gyro);
    }
    Eigen::Vector3d noise = randomVector(random, kNoise_rad);
    if (uniform(random) < options.outlier_fraction) noise *= 100;
    const Eigen::Matrix3d R_ba = expSO3(noise) * mounting * flight.motion(a, b).R_ba * mounting.transpose();
    const double t_s = k / kFrameRate;
    const Duration late = fromSeconds(lateness(t_s));
    monitor.addVision(a + late, b + late, R_ba);
  }
}

InertialExtrinsics configured() { return mountedCamera(kHeight_m); }

TEST(TimeshiftMonitor, FindsTheShiftWithinItsSigma) {
  for (const double late_s : {0.0, 0.02, 0.05, -0.03, 0.15}) {
    double squares = 0;
    constexpr int kFlights = 4;
    for (unsigned seed = 1; seed <= kFlights; ++seed) {
      TimeshiftMonitor monitor(configured());
      FlightOptions options;
      options.seed = seed;
      fly(monitor, simulation::Trajectory::ordinary(seed, kHeight_m), constant(late_s), options);
      ASSERT_TRUE(monitor.estimate().has_value()) << late_s << ", flight " << seed;
      // Late stamps: the exposure was earlier on the IMU's clock than they say.
      EXPECT_NEAR(monitor.estimate()->shift_s, -late_s, 0.0015) << "flight " << seed;
      squares += std::pow((monitor.estimate()->shift_s + late_s) / monitor.estimate()->sigma_s, 2);
      EXPECT_EQ(monitor.message().empty(), late_s == 0.0) << monitor.message();
    }
    EXPECT_LT(squares / kFlights, 4) << "the sigma is too small";
    EXPECT_GT(squares / kFlights, 0.05) << "the sigma is too large";
  }
}

TEST(TimeshiftMonitor, SaysByHowMuchAndWhatWouldFit) {
  TimeshiftMonitor monitor(configured());
  fly(monitor, simulation::Trajectory::brisk(3, kHeight_m), constant(0.05));
  EXPECT_EQ(
      monitor.message(),
      "the stamps of camera and IMU are 50 ms apart (sigma 1 ms); camera.timeshift_s: -0.044 would fit");
}

TEST(TimeshiftMonitor, RefusesWithoutRotation) {
  TimeshiftMonitor monitor(configured());
  fly(monitor, hovering(), constant(0.05));
  EXPECT_FALSE(monitor.estimate().has_value());
  EXPECT_EQ(monitor.message(), "");
  EXPECT_FALSE(monitor.drift().has_value());
}

TEST(TimeshiftMonitor, RefusesRotationsThatAreNotTheGyros) {
  TimeshiftMonitor monitor(configured());
  FlightOptions options;
  options.mounting_error = Eigen::Vector3d(M_PI, 0, 0);
  fly(monitor, simulation::Trajectory::ordinary(1, kHeight_m), constant(0), options);
  EXPECT_FALSE(monitor.estimate().has_value());
}

TEST(TimeshiftMonitor, ATurnedMountingAndOutliersAreNoShift) {
  TimeshiftMonitor monitor(configured());
  FlightOptions options;
  options.mounting_error = Eigen::Vector3d(1, -1, 1).normalized() * 3 * kDegree;
  options.outlier_fraction = 0.1;
  fly(monitor, simulation::Trajectory::ordinary(2, kHeight_m), constant(0), options);
  ASSERT_TRUE(monitor.estimate().has_value());
  EXPECT_NEAR(monitor.estimate()->shift_s, 0, 0.002);
  EXPECT_EQ(monitor.message(), "");
}

TEST(TimeshiftMonitor, FindsDriftAndOnlyWhereThereIsOne) {
  FlightOptions options;
  options.duration_s = 110;
  for (const double rate : {0.0, 1e-4, -2e-4}) {  // 0.1 ms a second: a camera's clock that is 100 ppm off
    TimeshiftMonitor monitor(configured());
    fly(
        monitor, simulation::Trajectory::ordinary(4, kHeight_m), [=](double t_s) { return rate * t_s; },
        options);
    const auto drift = monitor.drift();
    ASSERT_TRUE(drift.has_value());
    EXPECT_NEAR(drift->rate, -rate, 4e-5);
    EXPECT_EQ(monitor.message().find("drift") != std::string::npos, rate != 0) << monitor.message();
  }
}

TEST(TimeshiftMonitor, StartsAnewWhereTheCamerasClockWasSetBack) {
  TimeshiftMonitor monitor(configured());
  const auto trajectory = simulation::Trajectory::ordinary(5, kHeight_m);
  fly(monitor, trajectory, constant(0.02));
  ASSERT_TRUE(monitor.estimate().has_value());
  TimeshiftMonitor other = monitor;
  fly(other, trajectory, constant(0));
  ASSERT_TRUE(other.estimate().has_value());
  EXPECT_NEAR(other.estimate()->shift_s, 0, 0.0015);
}

}  // namespace
}  // namespace redbee::test
