#include "redbee/detection/parallax/border_structure.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

const cv::Size kSize(160, 120);
const cv::Mat kAllKnown = cv::Mat::zeros(kSize, CV_8U);
constexpr double kStretch_px = 16;

cv::Mat evidence(std::initializer_list<cv::Rect> where, double level = 0.8) {
  cv::Mat motion = cv::Mat::zeros(kSize, CV_32F);
  for (const cv::Rect& box : where) motion(box).setTo(level);
  return motion;
}

/// Mean over the inside of a box, away from its blurred edges.
double meanInside(const cv::Mat& map, const cv::Rect& box) {
  return cv::mean(map(cv::Rect(box.x + 4, box.y + 4, box.width - 8, box.height - 8)))[0];
}

TEST(BorderStructure, ObjectsInsideTheImageAreNone) {
  const cv::Mat fraction = fractionOfBorderStructure(evidence({{60, 40, 40, 30}}), kAllKnown, kStretch_px);
  EXPECT_EQ(fraction.type(), CV_32F);
  EXPECT_EQ(fraction.size(), kSize);
  EXPECT_EQ(cv::countNonZero(fraction > 1e-3), 0);
}

TEST(BorderStructure, StructuresOverAWideStretchAreFullyExcluded) {
  for (const cv::Rect& side : {cv::Rect(40, 80, 60, 40), cv::Rect(40, 0, 60, 40), cv::Rect(0, 40, 40, 60),
                               cv::Rect(120, 40, 40, 60)}) {
    const cv::Mat fraction = fractionOfBorderStructure(evidence({side}), kAllKnown, kStretch_px);
    EXPECT_GT(meanInside(fraction, side), 0.97) << side;
  }
}

TEST(BorderStructure, NarrowObjectsAtTheBorderAreKept) {
  const cv::Rect person(60, 96, 12, 24);
  const cv::Mat fraction = fractionOfBorderStructure(evidence({person}), kAllKnown, kStretch_px);
  EXPECT_LT(meanInside(fraction, person), 0.01);
}

TEST(BorderStructure, AMoverInFrontOfATreeKeepsItsExcess) {
  const cv::Rect tree(20, 40, 100, 80), mover(60, 60, 24, 24);
  cv::Mat motion = evidence({tree}, 0.3);
  motion(mover).setTo(0.9);
  const cv::Mat fraction = fractionOfBorderStructure(motion, kAllKnown, kStretch_px);
  EXPECT_NEAR(meanInside(fraction, mover), 0.3 / 0.9, 0.02);
}

TEST(BorderStructure, AStructureIsFollowedRoundCorners) {
  // From the lower border up, to the right and down again, where it ends above the border.
  const cv::Mat motion = evidence({{10, 20, 24, 100}, {10, 20, 120, 24}, {106, 20, 24, 60}});
  const cv::Mat fraction = fractionOfBorderStructure(motion, kAllKnown, kStretch_px);
  EXPECT_GT(meanInside(fraction, {106, 48, 24, 32}), 0.97);
}

TEST(BorderStructure, TheBorderIsThatOfTheKnownPart) {
  // The earlier frame does not show the left and lower parts: what ends there runs out.
  cv::Mat unknown = kAllKnown.clone();
  unknown(cv::Rect(0, 0, 30, 120)).setTo(255);
  unknown(cv::Rect(0, 100, 160, 20)).setTo(255);
  const cv::Rect facade(30, 40, 40, 40), ledge(90, 70, 40, 30), mover(100, 20, 20, 20);
  cv::Mat motion = evidence({facade, ledge, mover});
  motion.setTo(0, unknown);
  const cv::Mat fraction = fractionOfBorderStructure(motion, unknown, kStretch_px);
  EXPECT_GT(meanInside(fraction, facade), 0.97);
  EXPECT_GT(meanInside(fraction, ledge), 0.97);
  EXPECT_LT(meanInside(fraction, mover), 0.01);
}

TEST(BorderStructure, AnUnknownImageHasNone) {
  const cv::Mat unknown(kSize, CV_8U, cv::Scalar(255));
  EXPECT_EQ(cv::countNonZero(fractionOfBorderStructure(evidence({{0, 0, 160, 120}}), unknown, kStretch_px)),
            0);
}

}  // namespace
}  // namespace redbee
