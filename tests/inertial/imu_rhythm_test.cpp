#include "redbee/inertial/imu_rhythm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace redbee {
namespace {

constexpr int64_t kPeriod_us = 2500;

ImuTime at(int64_t us) { return ImuTime(Duration(1'700'000'000'000'000 + us)); }

/// A rhythm that has heard samples at 0, 2500, ... us, `count` of them.
ImuRhythm listening(int count, int64_t period_us = kPeriod_us) {
  ImuRhythm rhythm;
  for (int i = 0; i < count; ++i) EXPECT_TRUE(rhythm.isKeptBy(at(i * period_us)));
  return rhythm;
}

TEST(ImuRhythm, SamplesBetweenTheBeatsAreAnotherImus) {
  ImuRhythm rhythm = listening(40);
  for (int i = 40; i < 100; ++i) {
    EXPECT_TRUE(rhythm.isKeptBy(at(i * kPeriod_us)));
    EXPECT_FALSE(rhythm.isKeptBy(at(i * kPeriod_us + 1000)));
  }
}

/// Of its samples only those within a tenth of a period of a beat can be mistaken, a fifth.
TEST(ImuRhythm, AnotherImuMayHaveAnotherRate) {
  ImuRhythm rhythm = listening(40);
  int own = 0;
  int others = 0;
  int mistaken = 0;
  for (int64_t us = 40 * kPeriod_us; us < 400 * kPeriod_us; us += 10) {
    if (us % kPeriod_us == 0) own += rhythm.isKeptBy(at(us)) ? 1 : 0;
    if (us % 3710 != 0) continue;
    ++others;
    mistaken += rhythm.isKeptBy(at(us)) ? 1 : 0;
  }
  EXPECT_GE(own, 360 * 9 / 10);
  EXPECT_LE(mistaken, others / 5);
}

/// The second has the same rate, but for its oscillator, or half of it. Phases that are even, or close to the
/// first's beats, cannot be told apart.
TEST(ImuRhythm, OfTwoMixedFromTheBeginningTheFirstIsListenedTo) {
  for (const int64_t phase_us : {300, 400, 625, 700, 833, 1667, 1700, 2100}) {
    for (const int every : {1, 2}) {
      ImuRhythm rhythm;
      int own = 0;
      int foreign = 0;
      for (int i = 0; i < 400; ++i) {
        const bool is_told = i >= 100;
        own += rhythm.isKeptBy(at(i * kPeriod_us)) && is_told ? 1 : 0;
        if (i % every != 0) continue;
        foreign += rhythm.isKeptBy(at(i * kPeriod_us + phase_us + i / 10)) && is_told ? 1 : 0;
      }
      EXPECT_EQ(own, 300) << phase_us << " " << every;
      EXPECT_EQ(foreign, 0) << phase_us << " " << every;
    }
  }
}

/// Up to half a period of jitter, but no second source.
TEST(ImuRhythm, AnImuOfLessRegularTimesIsNotTakenForTwo) {
  for (const int64_t jitter_us : {150, 300, 600, 1200}) {
    std::mt19937 random(3);
    ImuRhythm rhythm;
    for (int i = 0; i < 4000; ++i) {
      const auto jitter = static_cast<int64_t>(random() % static_cast<uint64_t>(jitter_us));
      ASSERT_TRUE(rhythm.isKeptBy(at(i * kPeriod_us + jitter))) << jitter_us << " " << i;
    }
  }
}

TEST(ImuRhythm, LostLateAndRepeatedSamplesKeepIt) {
  ImuRhythm rhythm = listening(40);
  for (const int beat : {42, 41, 42, 47, 43, 44, 48}) EXPECT_TRUE(rhythm.isKeptBy(at(beat * kPeriod_us)));
}

TEST(ImuRhythm, JitterBelowATwentiethOfAPeriodKeepsIt) {
  std::mt19937 random(1);
  ImuRhythm rhythm;
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(rhythm.isKeptBy(at(i * kPeriod_us + static_cast<int64_t>(random() % 60)))) << i;
  }
}

TEST(ImuRhythm, IrregularTimesAreAllTaken) {
  std::mt19937 random(2);
  ImuRhythm rhythm;
  int64_t us = 0;
  for (int i = 0; i < 400; ++i) {
    us += 1500 + static_cast<int64_t>(random() % 2000);
    EXPECT_TRUE(rhythm.isKeptBy(at(us))) << i;
  }
}

/// Each change costs at most as many samples as half a second has.
TEST(ImuRhythm, AnImuThatChangesItsRateIsFollowed) {
  for (const int64_t period_us : {1900, 2000, 3300, 4000, 10'000}) {
    ImuRhythm rhythm = listening(40);
    int refused = 0;
    int latest_refused = 0;
    int64_t us = 39 * kPeriod_us;
    for (int i = 0; i < 1000; ++i) {
      us += period_us;
      if (rhythm.isKeptBy(at(us))) continue;
      ++refused;
      latest_refused = i;
    }
    EXPECT_LT(latest_refused * period_us, 500'000) << period_us;
    EXPECT_LT(refused * period_us, 250'000) << period_us;
  }
}

TEST(ImuRhythm, AnotherClockIsFollowed) {
  for (const int64_t jump_us : {int64_t{-3'600'000'000}, int64_t{-500'700}, int64_t{500'700}}) {
    ImuRhythm rhythm = listening(40);
    for (int i = 40; i < 100; ++i) EXPECT_TRUE(rhythm.isKeptBy(at(i * kPeriod_us + jump_us))) << jump_us;
  }
}

TEST(ImuRhythm, TheSecondIsTakenOnceTheFirstHasGone) {
  ImuRhythm rhythm = listening(40);
  int kept = 0;
  for (int i = 40; i < 100; ++i) kept += rhythm.isKeptBy(at(i * kPeriod_us + 1000)) ? 1 : 0;
  EXPECT_GE(kept, 49);
}

}  // namespace
}  // namespace redbee
