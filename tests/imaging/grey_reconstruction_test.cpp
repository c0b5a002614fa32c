#include "redbee/imaging/grey_reconstruction.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

cv::Mat empty() { return cv::Mat::zeros(60, 80, CV_32F); }

/// The outline of a box, 2 px wide.
cv::Mat frame(const cv::Rect& box, double level) {
  cv::Mat map = empty();
  map(box).setTo(level);
  map(cv::Rect(box.x + 2, box.y + 2, box.width - 4, box.height - 4)).setTo(0);
  return map;
}

double largestDifference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

cv::Mat1f filled(const cv::Mat1f& map, int gap_px) {
  cv::Mat1f without_holes = map.clone();
  fillHoles(without_holes, gap_px);
  return without_holes;
}

TEST(FillHoles, WhatAnOutlineGoesRoundTakesItsLevel) {
  const cv::Rect box(20, 10, 30, 24);
  cv::Mat whole = empty();
  whole(box).setTo(0.7);
  EXPECT_LT(largestDifference(filled(frame(box, 0.7), 0), whole), 1e-6);
}

TEST(FillHoles, NoHigherThanTheOutlinesLowestPlace) {
  const cv::Rect box(20, 10, 30, 24);
  cv::Mat map = frame(box, 0.7);
  map(cv::Rect(20, 18, 2, 2)).setTo(0.3);
  const cv::Mat without_holes = filled(map, 0);
  EXPECT_NEAR(without_holes.at<float>(22, 35), 0.3, 1e-6);
  EXPECT_NEAR(without_holes.at<float>(10, 35), 0.7, 1e-6) << "the outline itself stays";
}

TEST(FillHoles, AGapIsClosedUpToItsWidth) {
  const cv::Rect box(20, 10, 30, 24);
  cv::Mat map = frame(box, 0.7);
  map(cv::Rect(20, 18, 2, 4)).setTo(0);
  EXPECT_NEAR(filled(map, 0).at<float>(22, 35), 0, 1e-6);
  EXPECT_NEAR(filled(map, 2).at<float>(22, 35), 0, 1e-6);
  EXPECT_NEAR(filled(map, 4).at<float>(22, 35), 0.7, 1e-6);
}

TEST(FillHoles, WhatIsOpenTowardsTheImagesBorderIsNoHole) {
  cv::Mat map = empty();
  map(cv::Rect(0, 10, 30, 2)).setTo(0.7);
  map(cv::Rect(28, 10, 2, 24)).setTo(0.7);
  map(cv::Rect(0, 32, 30, 2)).setTo(0.7);
  EXPECT_LT(largestDifference(filled(map, 0), map), 1e-6);
}

TEST(FillHoles, EachOfTwoObjectsByItself) {
  const cv::Rect left(4, 10, 24, 24), right(40, 20, 30, 30);
  cv::Mat map = frame(left, 0.4), whole = empty();
  cv::max(map, frame(right, 0.9), map);
  whole(left).setTo(0.4);
  whole(right).setTo(0.9);
  EXPECT_LT(largestDifference(filled(map, 0), whole), 1e-6);
}

TEST(FillHoles, NothingFalls) {
  cv::Mat map(60, 80, CV_32F);
  cv::RNG random(1);
  random.fill(map, cv::RNG::UNIFORM, 0, 1);
  const cv::Mat without_holes = filled(map, 3);
  EXPECT_EQ(cv::countNonZero(without_holes < map), 0);
  double most = 0;
  cv::minMaxLoc(without_holes, nullptr, &most);
  EXPECT_LE(most, 1);
}

TEST(FillHoles, AnImageOfOnePixelAndAnEmptyMapAreUnchanged) {
  const cv::Mat one(1, 1, CV_32F, cv::Scalar(0.5));
  EXPECT_EQ(largestDifference(filled(one, 7), one), 0);
  EXPECT_EQ(largestDifference(filled(empty(), 7), empty()), 0);
}

TEST(Reconstruct, ALevelReachesAsFarAsItsPathNeverFallsBelow) {
  cv::Mat limit = cv::Mat::zeros(9, 9, CV_32F);
  limit.row(4).setTo(0.8);
  limit.at<float>(4, 5) = 0.5F;  // a saddle
  cv::Mat1f level = cv::Mat1f::zeros(9, 9);
  level.at<float>(4, 1) = 0.8F;
  reconstruct(limit, level);
  EXPECT_FLOAT_EQ(level.at<float>(4, 4), 0.8F);
  EXPECT_FLOAT_EQ(level.at<float>(4, 7), 0.5F);
  EXPECT_FLOAT_EQ(level.at<float>(3, 4), 0);
}

}  // namespace
}  // namespace redbee
