#include "redbee/evaluation/region_measures.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

cv::Mat1b square(int x, int y, int side = 20) {
  cv::Mat1b map = cv::Mat1b::zeros(100, 100);
  map(cv::Rect(x, y, side, side)) = 255;
  return map;
}

TEST(RegionMeasures, RegionSimilarityIsIntersectionOverUnion) {
  EXPECT_DOUBLE_EQ(regionSimilarity(square(10, 10), square(10, 10)), 1);
  EXPECT_DOUBLE_EQ(regionSimilarity(square(10, 10), square(20, 10)), 200.0 / 600);
  EXPECT_DOUBLE_EQ(regionSimilarity(square(10, 10), square(60, 60)), 0);
  EXPECT_DOUBLE_EQ(regionSimilarity(cv::Mat1b::zeros(100, 100), cv::Mat1b::zeros(100, 100)), 1);
}

/// The tolerance is 2 px here: 0.8 % of 141 px, rounded up.
TEST(RegionMeasures, ContoursWithinTheToleranceMatch) {
  EXPECT_DOUBLE_EQ(contourAccuracy(square(10, 10), square(10, 10)), 1);
  EXPECT_DOUBLE_EQ(contourAccuracy(square(10, 10), square(12, 10)), 1);
  EXPECT_LT(contourAccuracy(square(10, 10), square(14, 10)), 1);
  EXPECT_DOUBLE_EQ(contourAccuracy(square(10, 10), square(60, 60)), 0);
  EXPECT_DOUBLE_EQ(contourAccuracy(square(10, 10), cv::Mat1b::zeros(100, 100)), 0);
  EXPECT_DOUBLE_EQ(contourAccuracy(cv::Mat1b::zeros(100, 100), cv::Mat1b::zeros(100, 100)), 1);
}

/// A bar over the left half of a longer one, tolerance 9 px: of the mask's contour of 1000 px two long sides
/// of 400, the left side of 100 and both ends of the right side, 9 each, match; of the truth's 1800 two of
/// 409 and the left side.
TEST(RegionMeasures, ContourPrecisionAndRecallAreBalanced) {
  cv::Mat1b whole = cv::Mat1b::zeros(200, 1000), half = cv::Mat1b::zeros(200, 1000);
  whole(cv::Rect(100, 50, 800, 100)) = 255;
  half(cv::Rect(100, 50, 400, 100)) = 255;
  constexpr double kPrecision = 918.0 / 1000, kRecall = 918.0 / 1800;
  EXPECT_NEAR(contourAccuracy(half, whole), 2 * kPrecision * kRecall / (kPrecision + kRecall), 3e-3);
}

TEST(RegionMeasures, WhatIsUnknownBelongsToNeitherRegion) {
  cv::Mat1b labels = square(10, 10);
  labels(cv::Rect(40, 10, 20, 20)) = 128;
  RegionMeasures measures;
  measures.add(square(10, 10) | square(40, 10), labels);
  measures.add(cv::Mat1b::zeros(100, 100), labels);
  EXPECT_EQ(measures.frames(), 2);
  EXPECT_DOUBLE_EQ(measures.j(), 0.5);
  EXPECT_DOUBLE_EQ(measures.f(), 0.5);
  EXPECT_THROW(measures.add(cv::Mat1b::zeros(10, 10), labels), std::invalid_argument);
}

}  // namespace
}  // namespace redbee
