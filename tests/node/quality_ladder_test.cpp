#include "redbee/node/quality_ladder.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace redbee {
namespace {

constexpr Duration kPeriod = std::chrono::microseconds(41667);
constexpr Duration kLongest = std::chrono::milliseconds(450);

/// A stage that takes `costs[rung]` periods for a frame, more than one if it is slower than the camera.
struct Stage {
  QualityLadder ladder;
  std::vector<double> costs;
  Duration backlog{0};
  Duration longest_backlog{0};
  int changes = 0;

  explicit Stage(std::vector<double> of_rungs) : ladder(of_rungs.size() - 1), costs(std::move(of_rungs)) {}
  int complete = 0;  ///< frames on rung 0
  double burst = 0;  ///< periods by which something else holds the stage up every five seconds
  static constexpr int kBurstEvery = 120;

  /// `load`: times the costs.
  void run(int frames, double load = 1) {
    for (int k = 0; k < frames; ++k) {
      if (k % kBurstEvery == 0) backlog += std::chrono::duration_cast<Duration>(burst * kPeriod);
      const size_t before = ladder.rung();
      const size_t rung = ladder.update(backlog / kPeriod * kPeriod, kLongest);
      changes += rung != before ? 1 : 0;
      complete += rung == 0 ? 1 : 0;
      const double behind = costs[rung] * load - 1;
      backlog += std::chrono::duration_cast<Duration>(behind * kPeriod);
      backlog = std::clamp(backlog, Duration(0), kLongest);  // beyond, frames are skipped
      longest_backlog = std::max(longest_backlog, backlog);
    }
  }
};

TEST(QualityLadder, StaysUpWhileThereIsTime) {
  Stage stage({0.95, 0.7, 0.5});
  stage.run(1000);
  EXPECT_EQ(stage.ladder.rung(), 0U);
  EXPECT_EQ(stage.changes, 0);
}

TEST(QualityLadder, GoesDownBeforeFramesAreSkipped) {
  for (const double load : {1.05, 1.25, 1.4}) {
    Stage stage({1, 0.8, 0.7});
    stage.run(3000, load);
    EXPECT_LT(stage.longest_backlog, kLongest) << load;
  }
}

TEST(QualityLadder, GoesNoFurtherThanItMust) {
  Stage stage({1.2, 0.9, 0.6});
  stage.run(40);
  EXPECT_EQ(stage.ladder.rung(), 1U);
  stage.run(500);
  EXPECT_LE(stage.ladder.rung(), 1U);
}

TEST(QualityLadder, ComesUpAgain) {
  Stage stage({1, 0.8, 0.7});
  stage.run(200, 1.35);
  EXPECT_EQ(stage.ladder.rung(), 2U);
  stage.run(500, 0.9);
  EXPECT_EQ(stage.ladder.rung(), 0U);
}

/// Each attempt that fails makes the next one later.
TEST(QualityLadder, DoesNotFlutter) {
  Stage stage({1.2, 0.9});
  stage.run(1000);
  const int early = stage.changes;
  stage.run(1000);
  EXPECT_LE(early, 12);
  EXPECT_LE(stage.changes - early, 3);
}

TEST(QualityLadder, DoesNotFlutterWhereItIsAlmostFastEnough) {
  for (const double cost : {1.02, 1.05, 1.07}) {
    Stage stage({cost, 0.8 * cost});
    stage.run(4000);
    const int early = stage.changes;
    stage.run(4000);
    EXPECT_LE(stage.changes - early, 8) << cost;
  }
}

/// What holds the stage up now and then says nothing about the rung: half of the time is spent on it.
TEST(QualityLadder, ComesUpAgainAfterEachOfManyDisturbances) {
  Stage stage({0.8, 0.6});
  stage.burst = 4;
  stage.run(24 * 300);
  stage.complete = 0;
  stage.run(24 * 300);
  EXPECT_GE(stage.complete, 24 * 300 / 2);
}

/// A machine that was too slow for long, and is free now but for a short backlog every five seconds.
TEST(QualityLadder, ComesUpWithinTwoMinutesAlthoughDisturbed) {
  for (const double burst : {2.5, 4.}) {
    Stage stage({1.2, 0.9});
    stage.run(24 * 600);
    ASSERT_EQ(stage.ladder.rung(), 1U);
    stage.burst = burst;
    stage.complete = 0;
    stage.run(24 * 120, 0.7);
    EXPECT_GT(stage.complete, 0) << burst;
    stage.run(24 * 300, 0.7);  // each trial that only a disturbance ended makes the next one earlier
    stage.complete = 0;
    stage.run(24 * 300, 0.7);
    EXPECT_GE(stage.complete, 24 * 300 / 2) << burst;
  }
}

TEST(QualityLadder, DoesNotFlutterWhereItIsTooSlowAndDisturbed) {
  for (const double burst : {2.5, 4.}) {
    for (const double cost : {1.2, 1.5}) {
      Stage stage({cost, 0.6 * cost});
      stage.burst = burst;
      stage.run(4000);
      const int early = stage.changes;
      stage.run(4000);
      EXPECT_LE(stage.changes - early, 8) << cost << ", " << burst;
    }
  }
}

/// Between two disturbances there is nearly time enough: at most once down and up for each of them.
TEST(QualityLadder, ChangesOnlyWithTheDisturbancesWhereItIsAlmostFastEnough) {
  for (const double cost : {0.98, 1.02, 1.05, 1.1}) {
    Stage stage({cost, 0.7 * cost});
    stage.burst = 4;
    stage.run(4000);
    const int early = stage.changes;
    stage.run(4000);
    EXPECT_LE(stage.changes - early, 2 * (4000 / Stage::kBurstEvery + 1)) << cost;
    EXPECT_LT(stage.longest_backlog, kLongest) << cost;
  }
}

TEST(QualityLadder, WithoutRungsNothingChanges) {
  Stage stage({2});
  stage.run(100);
  EXPECT_EQ(stage.ladder.rung(), 0U);
}

}  // namespace
}  // namespace redbee
