// The estimate against clocks whose truth is known.
#include "redbee/mavlink/clock_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace redbee::mavlink {
namespace {

using Outcome = ClockEstimator::Outcome;

/// A device whose clock runs at 1 + drift, behind a way of two delays.
struct Simulation {
  int64_t boot_ns = 5'000'000'000;  ///< our clock, when the device's was 0
  double drift = 0;
  double there_s = 1e-3, back_s = 1e-3;          ///< the shortest
  double there_jitter_s = 0, back_jitter_s = 0;  ///< mean, exponential
  int64_t now_ns = 100'000'000'000;
  std::mt19937 random{7};

  int64_t deviceAt(int64_t host_ns) const {
    return std::llround(static_cast<double>(host_ns - boot_ns) * (1 + drift));
  }
  double jitter(double mean_s) {
    return mean_s > 0 ? std::exponential_distribution<double>(1 / mean_s)(random) : 0;
  }
  TimesyncExchange exchange() {
    const auto there_ns = std::llround((there_s + jitter(there_jitter_s)) * 1e9);
    const auto back_ns = std::llround((back_s + jitter(back_jitter_s)) * 1e9);
    const TimesyncExchange result{now_ns, deviceAt(now_ns + there_ns), now_ns + there_ns + back_ns};
    now_ns += 100'000'000;
    return result;
  }
};

/// Error of a time now [s]; runs `exchanges` first.
double errorAfter(ClockEstimator& clock, Simulation& simulation, int exchanges) {
  for (int i = 0; i < exchanges; ++i) clock.add(simulation.exchange());
  const auto host_ns = clock.toHost(simulation.deviceAt(simulation.now_ns));
  EXPECT_TRUE(host_ns);
  return static_cast<double>(host_ns.value_or(0) - simulation.now_ns) * 1e-9;
}

TEST(MavlinkClock, IsExactWithoutJitter) {
  ClockEstimator clock;
  Simulation simulation;
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 10)), 1e-8);
}

TEST(MavlinkClock, GivesNoTimesBeforeTheFifthExchange) {
  ClockEstimator clock;
  Simulation simulation;
  for (int i = 0; i < 4; ++i) clock.add(simulation.exchange());
  EXPECT_FALSE(clock.toHost(0));
  EXPECT_FALSE(clock.state());
  clock.add(simulation.exchange());
  EXPECT_TRUE(clock.state());
}

TEST(MavlinkClock, FindsTheDrift) {
  ClockEstimator clock;
  Simulation simulation;
  simulation.drift = 80e-6;
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 600)), 5e-6);
  EXPECT_NEAR(clock.state()->drift, 80e-6, 2e-6);
}

/// What no exchange shows is half of the difference of the shortest delays: the error is that, and within the
/// sigma.
TEST(MavlinkClock, AnAsymmetricWayShiftsByHalfItsDifference) {
  ClockEstimator clock;
  Simulation simulation;
  simulation.there_s = 3e-3;
  simulation.back_s = 1e-3;
  // theta is taken for 1 ms larger than it is: device times are mapped 1 ms too early.
  EXPECT_NEAR(errorAfter(clock, simulation, 300), -1e-3, 1e-5);
  EXPECT_GT(clock.state()->sigma_s, 1e-3);
}

struct Jitter {
  double there_s, back_s;
};
class MavlinkClockUnder : public testing::TestWithParam<Jitter> {};

/// 40 runs each, drift to 50e-6, exponential delays: the error stays within three sigmas, and its bound is
/// that of the gate.
TEST_P(MavlinkClockUnder, JitterIsGated) {
  double worst = 0, squares = 0, sigma = 0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    ClockEstimator clock;
    Simulation simulation;
    simulation.random.seed(static_cast<unsigned>(run + 1));
    simulation.drift = (run % 11 - 5) * 1e-5;
    simulation.there_jitter_s = GetParam().there_s;
    simulation.back_jitter_s = GetParam().back_s;
    const double error = errorAfter(clock, simulation, 600);
    ASSERT_TRUE(clock.state());
    EXPECT_LT(std::abs(error), 3 * clock.state()->sigma_s);
    worst = std::max(worst, std::abs(error));
    squares += error * error / kRuns;
    sigma = clock.state()->sigma_s;
  }
  std::printf("jitter %.1f and %.1f ms: RMS %.3f ms, worst %.3f ms, sigma %.3f ms\n",
              GetParam().there_s * 1e3, GetParam().back_s * 1e3, std::sqrt(squares) * 1e3, worst * 1e3,
              sigma * 1e3);
  // Of the mean of all exchanges the error would be half of the difference of the means.
  const double of_the_mean = std::abs(GetParam().there_s - GetParam().back_s) / 2;
  EXPECT_LT(std::sqrt(squares), std::max(of_the_mean / 4, 0.5e-3));
}
INSTANTIATE_TEST_SUITE_P(Delays, MavlinkClockUnder,
                         testing::Values(Jitter{0.2e-3, 0.2e-3}, Jitter{2e-3, 2e-3}, Jitter{5e-3, 0.2e-3},
                                         Jitter{0.2e-3, 5e-3}, Jitter{20e-3, 5e-3}));

TEST(MavlinkClock, HoldsWithoutAnswers) {
  ClockEstimator clock;
  Simulation simulation;
  simulation.drift = -40e-6;
  errorAfter(clock, simulation, 600);
  simulation.now_ns += 60'000'000'000;
  const auto host_ns = clock.toHost(simulation.deviceAt(simulation.now_ns));
  EXPECT_LT(std::abs(static_cast<double>(*host_ns - simulation.now_ns)) * 1e-9, 2e-4);
}

TEST(MavlinkClock, AForgedOrLateAnswerChangesNothing) {
  ClockEstimator clock;
  Simulation simulation;
  errorAfter(clock, simulation, 50);
  TimesyncExchange forged = simulation.exchange();
  forged.device_ns += 40'000'000;
  EXPECT_EQ(clock.add(forged), Outcome::kDoubted);
  EXPECT_FALSE(clock.toHost(0)) << "in doubt";
  EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kUsed);
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 1)), 1e-6);

  TimesyncExchange late = simulation.exchange();
  late.received_ns += 300'000'000;
  EXPECT_EQ(clock.add(late), Outcome::kSlow);
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 1)), 1e-6);
}

TEST(MavlinkClock, ARebootIsNoticedByTheSecondAnswer) {
  ClockEstimator clock;
  Simulation simulation;
  simulation.there_jitter_s = simulation.back_jitter_s = 1e-3;
  errorAfter(clock, simulation, 200);
  simulation.boot_ns = simulation.now_ns - 3'000'000'000;
  EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kDoubted);
  EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kRestarted);
  EXPECT_FALSE(clock.state());
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 100)), 1e-3);
}

TEST(MavlinkClock, ALongerWayIsTakenAfterAWhile) {
  ClockEstimator clock;
  Simulation simulation;
  errorAfter(clock, simulation, 100);
  simulation.there_s = simulation.back_s = 10e-3;
  EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kSlow);
  errorAfter(clock, simulation, 64);
  EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kUsed);
  EXPECT_LT(std::abs(errorAfter(clock, simulation, 10)), 1e-4);
  EXPECT_NEAR(clock.state()->round_trip_s, 20e-3, 1e-6);
}

/// As where this computer or the link is starved when the clock is first asked for: nobody started again.
TEST(MavlinkClock, AShorterWayThanEverIsNoRestart) {
  for (const double back_s : {5e-3, 50e-3, 300e-3}) {
    ClockEstimator clock;
    Simulation simulation;
    simulation.back_s = back_s;
    simulation.back_jitter_s = back_s / 5;
    for (int i = 0; i < 30; ++i) EXPECT_NE(clock.add(simulation.exchange()), Outcome::kRestarted) << back_s;
    simulation.back_s = 1e-3;
    simulation.back_jitter_s = 0;
    for (int i = 0; i < 30; ++i) EXPECT_EQ(clock.add(simulation.exchange()), Outcome::kUsed) << back_s;
    EXPECT_LT(std::abs(errorAfter(clock, simulation, 0)), 1e-4) << back_s;
  }
}

}  // namespace
}  // namespace redbee::mavlink
