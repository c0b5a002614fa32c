#include "redbee/evaluation/pixel_measures.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

cv::Mat row(const std::vector<uint8_t>& values) { return cv::Mat(values, true).reshape(1, 1); }

TEST(PixelMeasures, PerfectDetectionHasNoError) {
  PixelMeasures measures;
  measures.add(row({255, 255, 0, 0}), row({255, 255, 0, 0}));
  EXPECT_DOUBLE_EQ(measures.errorAtHalfRecall(), 0.0);
  EXPECT_DOUBLE_EQ(measures.bestF1(), 1.0);
}

TEST(PixelMeasures, NothingDetectedIsFullError) {
  PixelMeasures measures;
  measures.add(row({0, 0, 0, 0}), row({255, 255, 0, 0}));
  EXPECT_DOUBLE_EQ(measures.errorAtHalfRecall(), 1.0);
  EXPECT_DOUBLE_EQ(measures.bestF1(), 0.0);
}

TEST(PixelMeasures, NothingMovingIsFullError) {
  PixelMeasures measures;
  measures.add(row({9, 0, 0, 0}), row({0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(measures.errorAtHalfRecall(), 1.0);
  EXPECT_DOUBLE_EQ(measures.bestF1(), 0.0);
  EXPECT_EQ(measures.backgroundPixels(), 4);
}

TEST(PixelMeasures, RecallThatNeverReachesHalfIsFullError) {
  PixelMeasures measures;
  measures.add(row({200, 0, 0, 0}), row({255, 255, 255, 0}));
  EXPECT_DOUBLE_EQ(measures.errorAtHalfRecall(), 1.0);
}

TEST(PixelMeasures, HalfRecallIsInterpolatedBetweenNeighbouringThresholds) {
  // Threshold 200: 1 of 4 found, precision 1. Threshold 100: 3 of 4 found with 3 false alarms, precision 1/2.
  // Half recall lies in the middle of the two: precision 3/4.
  PixelMeasures measures;
  measures.add(row({200, 100, 100, 0, 100, 100, 100, 0}), row({255, 255, 255, 255, 0, 0, 0, 0}));
  EXPECT_NEAR(measures.errorAtHalfRecall(), 0.25, 1e-12);
  EXPECT_NEAR(measures.bestF1(), 2 * 0.5 * 0.75 / 1.25, 1e-12);
}

TEST(PixelMeasures, IgnoredTruthCountsNeitherWay) {
  PixelMeasures measures;
  measures.add(row({255, 255, 255}), row({255, 170, 128}));
  EXPECT_DOUBLE_EQ(measures.errorAtHalfRecall(), 0.0);
  EXPECT_EQ(measures.movingPixels() + measures.backgroundPixels(), 1);
}

TEST(PixelMeasures, FramesArePooledNotAveraged) {
  // 1 of 1 in one frame and 0 of 3 in the other is 1 of 4, not one half.
  PixelMeasures measures;
  measures.add(row({255, 0, 0}), row({255, 0, 0}));
  measures.add(row({0, 0, 0}), row({255, 255, 255}));
  EXPECT_DOUBLE_EQ(measures.at(1).recall, 0.25);
  EXPECT_EQ(measures.frames(), 2);
}

TEST(PixelMeasures, RefusesMapsOfDifferentSizes) {
  PixelMeasures measures;
  EXPECT_THROW(measures.add(row({1, 2}), row({1})), std::invalid_argument);
}

}  // namespace
}  // namespace redbee
