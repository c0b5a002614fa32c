// Vision's observations that reach the filter late.
#include <gtest/gtest.h>

#include "tests/support/filtered_flight.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 120;

struct Flown {
  NominalState state;
  std::vector<InertialHomography> homographies;
  int applied = 0;
};

/// Each observation arrives `late` frames after the next one could have been its due, those of `lost` never.
Flown fly(int late, int lost_each = 0) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  for (const AltitudeSample& sample : flight.altimeter(0, 8, 1)) filter.addAltitude(sample);
  std::mt19937 random(7);
  std::vector<std::optional<HomographyObservation>> observations;
  Flown flown;
  const auto give = [&](int k) {
    if (k < 0 || !observations[static_cast<size_t>(k)]) return;
    flown.applied += filter.correct(*observations[static_cast<size_t>(k)]).applied ? 1 : 0;
  };
  for (int k = 0; k < kFrames; ++k) {
    flown.homographies.push_back(filter.advanceTo(frameTime(k)));
    const HomographyObservation z = flight.observe(flown.homographies.back(), random);
    const bool is_lost = k == 0 || (lost_each > 0 && k % lost_each == 0);
    observations.push_back(is_lost ? std::nullopt : std::optional(z));
    give(k - late);
  }
  for (int k = kFrames - late; k < kFrames; ++k) give(k);
  flown.state = *filter.state();
  return flown;
}

void expectEqual(const NominalState& a, const NominalState& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.R_GI, b.R_GI);
  EXPECT_EQ(a.v_GI, b.v_GI);
  EXPECT_EQ(a.camera_height_m, b.camera_height_m);
  EXPECT_EQ(a.gyro_bias, b.gyro_bias);
  EXPECT_EQ(a.accel_bias, b.accel_bias);
  EXPECT_EQ(a.R_CI, b.R_CI);
}

TEST(LateObservations, LeaveTheStateThatTheyWouldHaveLeftInTime) {
  for (const int lost_each : {0, 3}) {
    const Flown in_time = fly(0, lost_each);
    for (const int late : {1, 6, 15}) {
      const Flown flown = fly(late, lost_each);
      EXPECT_EQ(flown.applied, in_time.applied) << late;
      expectEqual(flown.state, in_time.state);
    }
  }
}

/// As after a hang of vision: those of `together` frames arrive at once, after the last of them or after the
/// frame that follows.
Flown flyInParts(int together, bool after_next) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  for (const AltitudeSample& sample : flight.altimeter(0, 8, 1)) filter.addAltitude(sample);
  std::mt19937 random(7);
  std::vector<HomographyObservation> waiting;
  Flown flown;
  const auto give = [&] {
    for (const CorrectionReport& report : filter.correct(waiting)) flown.applied += report.applied ? 1 : 0;
    waiting.clear();
  };
  for (int k = 0; k < kFrames; ++k) {
    const InertialHomography result = filter.advanceTo(frameTime(k));
    if (after_next && k % together == 0) give();
    const HomographyObservation z = flight.observe(result, random);
    if (k > 0) waiting.push_back(z);
    if (!after_next && (k + 1) % together == 0) give();
  }
  give();
  flown.state = *filter.state();
  return flown;
}

TEST(LateObservations, ThatArriveTogetherLeaveTheStateOfThoseInTime) {
  const Flown in_time = fly(0);
  for (const int together : {1, 2, 5, 12, 18}) {
    for (const bool after_next : {false, true}) {
      const Flown flown = flyInParts(together, after_next);
      EXPECT_EQ(flown.applied, in_time.applied) << together;
      expectEqual(flown.state, in_time.state);
    }
  }
}

TEST(LateObservations, ThatArriveTogetherAreEachUsedOnce) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  InertialFilter filter = flight.filter(flight.parameters());
  std::mt19937 random(7);
  std::vector<HomographyObservation> all;
  filter.advanceTo(frameTime(0));
  for (int k = 1; k < 10; ++k) {
    all.push_back(flight.observe(filter.advanceTo(frameTime(k)), random));
    all.push_back(all.back());
  }
  int applied = 0;
  for (const CorrectionReport& report : filter.correct(all)) applied += report.applied ? 1 : 0;
  EXPECT_EQ(applied, 9);
  for (const CorrectionReport& report : filter.correct(all)) EXPECT_FALSE(report.applied);
}

TEST(LateObservations, AreOfUseFromTheNextFrameOn) {
  const FilteredFlight flight(1, 8, ConsumerImu(1));
  const auto error = [&](const Flown& flown) {
    double sum = 0;
    for (int k = 60; k < kFrames; ++k)
      sum += flight.transferError(flown.homographies[static_cast<size_t>(k)]);
    return sum / (kFrames - 60);
  };
  EXPECT_LT(error(fly(6)), 0.3);
  EXPECT_GT(error(fly(kFrames)), 2 * error(fly(6))) << "what they must improve";
}

TEST(LateObservations, OfLongAgoAreNotUsed) {
  constexpr int kWithin = 19;  // the newest frame and those of the 0.75 s before it
  EXPECT_EQ(fly(30).applied, kWithin);
}

}  // namespace
}  // namespace redbee::test
