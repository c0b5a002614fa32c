// The inertial filter where samples are late, missing or damaged, and where clocks jump.
#include <gtest/gtest.h>

#include <limits>

#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "tests/support/filtered_flight.hpp"

namespace redbee::test {
namespace {

TEST(InertialFilter, LateAndRepeatedSamplesChangeNothing) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter straight = flight.filter(flight.parameters());
  InertialFilter shuffled(camera(), flight.parameters());
  for (std::size_t i = 0; i + 1 < flight.samples.size(); i += 2) {
    shuffled.addImu(flight.samples[i + 1]);
    shuffled.addImu(flight.samples[i]);
    shuffled.addImu(flight.samples[i + 1]);
  }
  for (int k = 0; k < 24; ++k) {
    EXPECT_EQ(straight.advanceTo(frameTime(k)).H, shuffled.advanceTo(frameTime(k)).H);
  }
}

TEST(InertialFilter, AnImuGapIsBridgedWithALargerCovariance) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter(camera(), flight.parameters());
  const ImuTime begin = toImu(kStart, std::chrono::milliseconds(1020));
  for (const ImuSample& s : flight.samples) {
    if (s.time < begin || s.time > begin + std::chrono::milliseconds(150)) filter.addImu(s);
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

/// As images over a network come, which are stamped when they arrive: readers refuse what cannot be a
/// covariance.
TEST(InertialFilter, FramesOfOneBurstHaveCovariances) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  for (int k = 0; k < 48; ++k) {
    for (const auto delay : {0, 250, 252}) {
      const InertialHomography result = filter.advanceTo(frameTime(k) + std::chrono::microseconds(delay));
      const Eigen::Matrix3d& P = result.rotation_covariance;
      EXPECT_LE((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-12 * P.diagonal().maxCoeff())
          << k << ' ' << delay;
      EXPECT_EQ(result.covariance, Matrix8d(result.covariance.transpose()));
      EXPECT_TRUE(!result.valid || LdltFactors(result.covariance).smallestPivot() > 0) << k << ' ' << delay;
    }
  }
}

TEST(InertialFilter, ALostImuIsReportedAndItsReturnUsed) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter(camera(), flight.parameters());
  std::size_t next = 0;
  std::mt19937 random(2);
  double error = 0;
  for (int k = 0; k <= 144; ++k) {
    const bool lost = k >= 24 && k < 48;
    while (next < flight.samples.size() &&
           flight.samples[next].time <= toImu(frameTime(k), std::chrono::milliseconds(10))) {
      if (!lost) filter.addImu(flight.samples[next]);
      ++next;
    }
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (lost && k > 25) {
      EXPECT_EQ(result.status, InertialStatus::kNoImu) << k;
    }
    if (lost && k > 25) {
      EXPECT_FALSE(result.valid);
    }
    if (result.valid) filter.correct(flight.observe(result, random));
    if (k > 120) error += flight.transferError(result) / 24;
  }
  EXPECT_LT(error, 0.3);
}

TEST(InertialFilter, TheHeightOutlivesAnOutage) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialParameters parameters = flight.parameters();
  parameters.extrinsics.start_height_m *= 0.6;
  parameters.extrinsics.start_height_sigma_m = 3;
  InertialFilter filter(camera(), parameters);
  const auto altitudes = flight.altimeter(0, 4, 5);
  std::size_t next = 0;
  std::size_t next_altitude = 0;
  int restarts = 0;
  InertialHomography result;
  for (int k = 0; k <= 130; ++k) {
    const bool lost = k >= 96 && k < 120;
    while (next < flight.samples.size() &&
           flight.samples[next].time <= toImu(frameTime(k), std::chrono::milliseconds(10))) {
      if (!lost) filter.addImu(flight.samples[next]);
      ++next;
    }
    while (next_altitude < altitudes.size() &&
           altitudes[next_altitude].time <= toImu(frameTime(k), Duration(0))) {
      filter.addAltitude(altitudes[next_altitude++]);
    }
    result = filter.advanceTo(frameTime(k));
    restarts += k > 0 && result.status == InertialStatus::kInitialising ? 1 : 0;
  }
  EXPECT_EQ(restarts, 1);
  const double truth = flight.motion(frameTime(130), frameTime(131)).h_a;
  EXPECT_NEAR(result.height_m, truth, 3 * result.height_sigma_m);
  EXPECT_LT(result.height_m / truth, 1.3);
  EXPECT_GT(result.height_m / truth, 0.7) << "it restarted at the configured height";
}

TEST(InertialFilter, RestartsWhereClocksJump) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  for (int k = 0; k < 30; ++k) filter.advanceTo(frameTime(k));
  EXPECT_EQ(filter.advanceTo(frameTime(29)).status, InertialStatus::kClockJump);  // repeated: nothing moves
  EXPECT_TRUE(filter.advanceTo(frameTime(30)).valid);
  EXPECT_EQ(filter.advanceTo(frameTime(20)).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(21)).valid);
  EXPECT_EQ(filter.advanceTo(frameTime(21 + 24 * 3)).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(22 + 24 * 3)).valid);
  for (const CameraTime absurd : {CameraTime::min(), CameraTime::max()}) {
    EXPECT_EQ(filter.advanceTo(absurd).status, InertialStatus::kClockJump);
  }
}

TEST(InertialFilter, BothClocksSetBackTogetherAreFollowed) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  for (int k = 0; k < 30; ++k) filter.advanceTo(frameTime(k));
  constexpr Duration kBack = std::chrono::seconds(500);
  for (ImuSample s : flight.samples) {
    s.time -= kBack;
    filter.addImu(s);
  }
  EXPECT_EQ(filter.advanceTo(frameTime(30) - kBack).status, InertialStatus::kClockJump);
  EXPECT_TRUE(filter.advanceTo(frameTime(31) - kBack).valid);
}

TEST(InertialFilter, DamagedSamplesAreRefused) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      filter.addImu({toImu(kStart, Duration(0)), Eigen::Vector3d::Constant(nan), Eigen::Vector3d::Zero()}));
  EXPECT_FALSE(filter.addAltitude({toImu(kStart, Duration(0)), nan, 0.1}));
  EXPECT_FALSE(filter.addAltitude({toImu(kStart, Duration(0)), 3.0, 0.0}));
  EXPECT_FALSE(filter.addImu({ImuTime::min(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}));
  filter.advanceTo(frameTime(0));
  EXPECT_TRUE(filter.advanceTo(frameTime(1)).H.allFinite());
}

TEST(InertialFilter, AbsurdButFiniteSamplesNeverPublishNaN) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter(camera(), flight.parameters());
  for (ImuSample s : flight.samples) {
    if (s.time > toImu(frameTime(10), Duration(0)) && s.time < toImu(frameTime(11), Duration(0)))
      s.accel *= 1e200;
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
  InertialFilter filter(camera(), InertialParameters());
  EXPECT_FALSE(filter.covers(frameTime(0)));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(filter.advanceTo(frameTime(k)).status, InertialStatus::kNoImu);
  EXPECT_FALSE(filter.state().has_value());
}

}  // namespace
}  // namespace redbee::test
