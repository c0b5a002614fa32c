// An inertial process that is killed in flight is warm-started from the filter snapshot.
#include <gtest/gtest.h>

#include "tests/support/warm_start_run.hpp"

namespace redbee::test {
namespace {

Errors operator+(const Errors& a, const Errors& b) {
  return {a.first_px + b.first_px, a.second_px + b.second_px, a.height + b.height};
}
Errors operator/(const Errors& a, double n) { return {a.first_px / n, a.second_px / n, a.height / n}; }

TEST(WarmStart, ARestartedProcessKnowsWhatTheFlightHasLearned) {
  Errors before;
  Errors without;
  Errors with;
  constexpr int kFlights = 6;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    const WarmStartFlight flight(seed);
    FaultInjection dropped;
    dropped.drop_warm_start = true;
    const RunResult warm = run(flight);
    EXPECT_NE(warm.log.find("warm start from the filter snapshot"), std::string::npos) << warm.log;
    before = before + errorsFrom(flight, warm, kKilledAt - 25);
    with = with + errorsFrom(flight, warm, kBackAt + 1);
    without = without + errorsFrom(flight, run(flight, dropped), kBackAt + 1);
  }
  before = before / kFlights;
  with = with / kFlights;
  without = without / kFlights;
  print("before", before);
  print("without", without);
  print("warm start", with);
  EXPECT_GT(without.height, 0.2) << "the height must be what is lost";
  EXPECT_LT(with.height, 0.1);
  EXPECT_LT(with.first_px, 0.6 * without.first_px);
  EXPECT_LT(with.second_px, 0.6 * without.second_px);
}

/// Otherwise a process that crashes right after its start would overwrite the snapshot.
TEST(WarmStart, IsNotPublishedBeforeAnythingWasLearned) {
  const WarmStartFlight flight(1);
  FaultInjection dropped;
  dropped.drop_warm_start = true;
  for (const filter_snapshot_t& snapshot : run(flight, dropped).snapshots) {
    EXPECT_TRUE(snapshot.utime < toUtime(frameTime(kKilledAt)) ||
                snapshot.utime > toUtime(frameTime(kBackAt + 12)));
    EXPECT_GT(snapshot.utime, toUtime(frameTime(12)));
  }
}

TEST(WarmStart, ServesForSecondsAndNoLonger) {
  const WarmStartFlight flight(1);
  FaultInjection faults;
  faults.restarted_at = kKilledAt + 40;
  const RunResult after_less_than_two = run(flight, faults);
  EXPECT_NE(after_less_than_two.log.find("warm start from"), std::string::npos) << after_less_than_two.log;
  print("1.7 s later", errorsFrom(flight, after_less_than_two, faults.restarted_at + 1));
  faults.restarted_at = kKilledAt + 56;
  const RunResult after_more = run(flight, faults);
  EXPECT_NE(after_more.log.find("too old"), std::string::npos) << after_more.log;
}

/// Without a restart no warm start is published, for instance while a recording is replayed beside the
/// flight.
TEST(WarmStart, IsNotPublishedWithoutARestart) {
  const WarmStartFlight flight(1);
  FaultInjection none;
  none.restarted_at = -1;
  const RunResult result = run(flight, none);
  EXPECT_EQ(result.log, "");
  EXPECT_GT(result.snapshots.size(), 300U);
  EXPECT_EQ(result.offers, 0);
}

/// The state of a filter that vision contradicts has diverged and must not be restored.
TEST(WarmStart, AStateThatVisionContradictsIsNotPublished) {
  const WarmStartFlight flight(1);
  constexpr int kWrongFrom = 180;
  FaultInjection faults;
  faults.corrupt_vision = [](int k, visual_homography_t& m) {
    if (k < kWrongFrom) return;
    // The image rolls back and forth while the gyro measures no such rotation.
    const Eigen::Vector3d roll(0, 0, k % 2 == 0 ? 0.5 : -0.5);
    const Eigen::Matrix3d K = camera().K();
    fill(m.ground.H, normaliseHomography(K * expSO3(roll) * K.inverse() * matrix3(m.ground.H)));
  };
  const RunResult result = run(flight, faults);
  int after = 0;
  for (const filter_snapshot_t& snapshot : result.snapshots) {
    after +=
        snapshot.utime > toUtime(frameTime(kWrongFrom + 1)) && snapshot.utime < toUtime(frameTime(kKilledAt));
  }
  EXPECT_GT(result.snapshots.size(), 150U);
  EXPECT_EQ(after, 0);
  EXPECT_NE(result.log.find("too old"), std::string::npos) << result.log;
}

/// Plausible, but wrong by a factor of two: no check detects it. It is no worse than a wrong configuration.
TEST(WarmStart, AWrongHeightThatCouldBeRightIsCorrected) {
  for (const bool altimeter : {false, true}) {
    const WarmStartFlight flight(2, altimeter);
    FaultInjection faults;
    faults.corrupt_snapshot = [](filter_snapshot_t& m) { m.height *= 2; };
    const RunResult result = run(flight, faults);
    const Errors errors = errorsFrom(flight, result, kBackAt + 1);
    print(altimeter ? "twice, altimeter" : "twice as high", errors);
    EXPECT_LT(errors.second_px, 0.5);
    if (altimeter) {
      EXPECT_NEAR(result.homographies.at(kFrames - 1).camera_height, flight.trueHeight(kFrames - 1), 0.3);
    }
  }
}

}  // namespace
}  // namespace redbee::test
