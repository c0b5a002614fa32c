// Hand-made tracks whose measures follow from the definitions by counting.
#include "redbee/evaluation/tracking_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace redbee {
namespace {

TrackedBox box(int id, double x, double width = 10) { return {id, {x, 0, width, 10}}; }

TEST(TrackingMeasures, PerfectTracksScoreOne) {
  TrackingEvaluation evaluation;
  for (int k = 0; k < 10; ++k) evaluation.add({box(1, k), box(2, 100 + k)}, {box(7, k), box(3, 100 + k)});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_EQ(m.matches, 20);
  EXPECT_EQ(m.id_switches, 0);
  for (const double value :
       {m.recall, m.mean_overlap, m.mota, m.idf1, m.hota, m.detection_accuracy, m.association_accuracy})
    EXPECT_DOUBLE_EQ(value, 1);
  EXPECT_EQ(m.false_boxes_per_frame, 0);
}

TEST(TrackingMeasures, NothingDetectedScoresZero) {
  TrackingEvaluation evaluation;
  evaluation.add({box(1, 0)}, {});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_EQ(m.mota, 0);
  EXPECT_EQ(m.idf1, 0);
  EXPECT_EQ(m.hota, 0);
}

TEST(TrackingMeasures, FalseBoxesCostMotaAndMayMakeItNegative) {
  TrackingEvaluation evaluation;
  for (int k = 0; k < 4; ++k) evaluation.add({box(1, 0)}, {box(1, 50), box(2, 90)});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_DOUBLE_EQ(m.mota, -2);  // (0 - 8 - 0) / 4
  EXPECT_DOUBLE_EQ(m.false_boxes_per_frame, 2);
}

/// One object over 10 frames, its track replaced by another after 6.
TEST(TrackingMeasures, ABrokenTrackIsOneSwitch) {
  TrackingEvaluation evaluation;
  for (int k = 0; k < 10; ++k) evaluation.add({box(1, 0)}, {box(k < 6 ? 1 : 2, 0)});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_EQ(m.id_switches, 1);
  EXPECT_DOUBLE_EQ(m.mota, 0.9);
  EXPECT_DOUBLE_EQ(m.idf1, 0.6);  // 2 * 6 / (10 + 10)
  EXPECT_DOUBLE_EQ(m.detection_accuracy, 1);
  // Track 1: 6 of a union of 10; track 2: 4 of 10. (6 * 0.6 + 4 * 0.4) / 10
  EXPECT_DOUBLE_EQ(m.association_accuracy, 0.52);
  EXPECT_DOUBLE_EQ(m.hota, std::sqrt(0.52));
}

/// Two objects whose tracks change places half-way: every box matches, each identity for half of the time.
TEST(TrackingMeasures, SwappedIdentities) {
  TrackingEvaluation evaluation;
  for (int k = 0; k < 8; ++k)
    evaluation.add({box(1, 0), box(2, 50)}, {box(k < 4 ? 1 : 2, 0), box(k < 4 ? 2 : 1, 50)});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_EQ(m.id_switches, 2);
  EXPECT_DOUBLE_EQ(m.mota, 14.0 / 16);
  EXPECT_DOUBLE_EQ(m.idf1, 0.5);
  // Each of the four pairs: 4 matches of a union of 8 + 8 - 4.
  EXPECT_DOUBLE_EQ(m.association_accuracy, 1.0 / 3);
}

/// A box of 10 against one of 16 that holds it: overlap 0.625.
TEST(TrackingMeasures, MatchesNeedTheirOverlap) {
  TrackingEvaluation evaluation;
  for (int k = 0; k < 5; ++k) evaluation.add({box(1, 0)}, {box(1, 0, 16)});
  EXPECT_EQ(evaluation.measures(0.5).matches, 5);
  EXPECT_DOUBLE_EQ(evaluation.measures(0.5).mean_overlap, 0.625);
  EXPECT_EQ(evaluation.measures(0.7).matches, 0);
  // It matches at 0.05 to 0.60: at 12 of the 19 overlaps.
  EXPECT_DOUBLE_EQ(evaluation.measures().hota, 12.0 / 19);
}

/// The better overlap does not take an object away from the track that had it in the frame before.
TEST(TrackingMeasures, ContinuityGoesBeforeOverlap) {
  TrackingEvaluation evaluation;
  evaluation.add({box(1, 0)}, {box(1, 0)});
  evaluation.add({box(1, 0)}, {box(1, 2), box(2, 0)});
  const TrackingMeasures m = evaluation.measures();
  EXPECT_EQ(m.id_switches, 0);
  EXPECT_EQ(m.matches, 2);
}

TEST(TrackingMeasures, AnIdentityTwiceInAFrameIsRefused) {
  TrackingEvaluation evaluation;
  EXPECT_THROW(evaluation.add({box(1, 0), box(1, 50)}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace redbee
