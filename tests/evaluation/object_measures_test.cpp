#include "redbee/evaluation/object_measures.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kSide = 40;

cv::Mat1b emptyMask() { return cv::Mat1b::zeros(kSide, kSide); }

cv::Mat maskWith(const std::vector<cv::Rect>& boxes, int value = 255) {
  cv::Mat mask = emptyMask();
  for (const cv::Rect& box : boxes) mask(box).setTo(value);
  return mask;
}

ObjectTruth boxTruth(const std::vector<cv::Rect2d>& boxes) {
  ObjectTruth truth;
  for (const cv::Rect2d& box : boxes)
    truth.objects.push_back({static_cast<int>(truth.objects.size()) + 1, box, true});
  return truth;
}

TEST(ObjectMeasures, AQuarterOfTheVisiblePixelsFindsAnObject) {
  const ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 8, 4}}));
  EXPECT_EQ(countObjects(maskWith({{0, 0, 2, 4}}), truth).found, 1);
  cv::Mat less = maskWith({{0, 0, 2, 4}});
  less.at<uint8_t>(0, 0) = 0;
  EXPECT_EQ(countObjects(less, truth).found, 0);
}

TEST(ObjectMeasures, EveryRegionOfAMaskIsAnObject) {
  const ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 5, 5}, {20, 20, 5, 5}}));
  const ObjectCounts counts = countObjects(maskWith({{20, 20, 5, 5}}), truth);
  EXPECT_EQ(counts.present, 2);
  EXPECT_EQ(counts.found, 1);
  EXPECT_EQ(counts.false_alarms, 0);
}

TEST(ObjectMeasures, AnEmptyMaskHasNoFalseAlarms) {
  ObjectMeasures measures;
  measures.add(emptyMask(), objectsOfMask(maskWith({{0, 0, 5, 5}})));
  EXPECT_EQ(measures.recall(), 0);
  EXPECT_EQ(measures.falseAlarmsPerFrame(), 0);
  EXPECT_EQ(measures.falseAreaFraction(), 0);
}

TEST(ObjectMeasures, WhereNothingMovesEveryComponentIsAFalseAlarm) {
  ObjectMeasures measures;
  measures.add(maskWith({{0, 0, 4, 4}, {10, 10, 2, 2}}), objectsOfMask(emptyMask()));
  measures.add(emptyMask(), objectsOfMask(emptyMask()));
  EXPECT_EQ(measures.counts().present, 0);
  EXPECT_EQ(measures.recall(), 0);
  EXPECT_DOUBLE_EQ(measures.falseAlarmsPerFrame(), 1.0);
  EXPECT_DOUBLE_EQ(measures.falseAreaFraction(), 20.0 / (kSide * kSide) / 2);
}

TEST(ObjectMeasures, AComponentThatTouchesAnObjectIsNoFalseAlarmHoweverLarge) {
  const ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 5, 5}}));
  const ObjectCounts counts = countObjects(maskWith({{0, 0, 30, 1}}), truth);
  EXPECT_EQ(counts.false_alarms, 0);
  EXPECT_EQ(counts.false_area, 0);
  EXPECT_EQ(counts.found, 0);  // a fifth of it is covered
}

TEST(ObjectMeasures, AComponentMostlyInAnIgnoredAreaDoesNotCount) {
  const ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 10, 10}}, 128));
  EXPECT_EQ(countObjects(maskWith({{7, 0, 4, 10}}), truth).false_alarms, 0);
  const ObjectCounts outside = countObjects(maskWith({{8, 0, 10, 10}}), truth);
  EXPECT_EQ(outside.false_alarms, 1);
  EXPECT_EQ(outside.false_area, 80);
}

TEST(ObjectMeasures, AStoppedObjectIsNeitherMissedNorAFalseAlarm) {
  ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 5, 5}}));
  truth.objects[0].counts = false;
  EXPECT_EQ(countObjects(emptyMask(), truth).present, 0);
  EXPECT_EQ(countObjects(maskWith({{0, 0, 5, 5}}), truth).false_alarms, 0);
}

TEST(ObjectMeasures, AnObjectOfFewPixelsIsNeitherMissedNorAFalseAlarm) {
  const ObjectTruth truth = objectsOfMask(maskWith({{0, 0, 11, 1}}));
  EXPECT_EQ(countObjects(emptyMask(), truth).present, 0);
  EXPECT_EQ(countObjects(maskWith({{0, 0, 11, 1}}), truth).false_alarms, 0);
  EXPECT_EQ(countObjects(emptyMask(), objectsOfMask(maskWith({{0, 0, 12, 1}}))).present, 1);
}

TEST(ObjectMeasures, BoxesAreFoundByOverlapWithAComponentsBox) {
  // Grown by 2 px each, boxes of 16 px side are 20 px wide: shifted by s px they overlap by (20 - s) / (20 +
  // s), which is 0.2 at 13.3 px.
  const ObjectTruth truth = boxTruth({{2, 2, 16, 16}});
  EXPECT_EQ(countObjects(maskWith({{15, 2, 16, 16}}), truth).found, 1);
  EXPECT_EQ(countObjects(maskWith({{16, 2, 16, 16}}), truth).found, 0);
}

TEST(ObjectMeasures, TinyBoxesTolerateTheLabelsError) {
  // Side by side, without a common pixel: grown to 8 x 8, they overlap by 4 of 12.
  const ObjectTruth truth = boxTruth({{10, 10, 4, 4}});
  EXPECT_EQ(countObjects(maskWith({{14, 10, 4, 4}}), truth).found, 1);
  EXPECT_EQ(countObjects(maskWith({{18, 10, 4, 4}}), truth).found, 0);
}

TEST(ObjectMeasures, AComponentAwayFromAllBoxesIsAFalseAlarm) {
  const ObjectCounts counts = countObjects(maskWith({{30, 30, 5, 4}}), boxTruth({{2, 2, 10, 10}}));
  EXPECT_EQ(counts.false_alarms, 1);
  EXPECT_EQ(counts.false_area, 20);
  EXPECT_EQ(counts.present, 1);
}

TEST(ObjectMeasures, RecallPoolsTheFrames) {
  ObjectMeasures measures;
  measures.add(maskWith({{0, 0, 5, 5}}), objectsOfMask(maskWith({{0, 0, 5, 5}})));
  measures.add(emptyMask(), objectsOfMask(maskWith({{0, 0, 5, 5}, {10, 10, 5, 5}, {20, 20, 5, 5}})));
  EXPECT_DOUBLE_EQ(measures.recall(), 0.25);
}

TEST(ObjectMeasures, RefusesMapsThatDoNotFit) {
  EXPECT_THROW(countObjects(cv::Mat::zeros(3, 3, CV_8U), objectsOfMask(emptyMask())), std::invalid_argument);
}

}  // namespace
}  // namespace redbee
