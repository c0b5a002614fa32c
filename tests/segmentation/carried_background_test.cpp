#include "segmentation/carried_background.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kFrame_s = 0.04;
constexpr int kPictures = 12;
const cv::Size kSize(160, 120);
const cv::Rect kPatch(60, 50, 20, 20);

/// Smooth colours, so that resampling costs no more than a few grey levels.
cv::Mat scene(double shift_x) {
  cv::Mat picture(kSize, CV_8UC3);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double u = x - shift_x;
      picture.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uint8_t>(120 + 40 * std::sin(u / 9)),
                                     cv::saturate_cast<uint8_t>(120 + 40 * std::cos(y / 11.0)),
                                     cv::saturate_cast<uint8_t>(120 + 40 * std::sin((u + y) / 13))};
    }
  }
  return picture;
}

cv::Mat nothingMoves() { return cv::Mat::zeros(kSize, CV_32F); }

SceneMotion pan(double px) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = px;
  return {H, std::nullopt, Eigen::Matrix3d::Identity()};
}

double mean(const cv::Mat& map, const cv::Rect& where) { return cv::mean(map(where))[0]; }

class Background : public ::testing::Test {
 protected:
  CarriedBackground background_{SegmentationParameters{}};
};

TEST_F(Background, KnowsNothingAtFirst) { EXPECT_EQ(cv::countNonZero(background_.unlike(scene(0))), 0); }

TEST_F(Background, FollowsAPanAndKnowsWhatItHasNotSeen) {
  constexpr double kPan = 3.4;
  for (int k = 0; k < kPictures; ++k) {
    background_.carry(pan(kPan));
    background_.learn(scene(k * kPan), nothingMoves(), kFrame_s);
  }
  background_.carry(pan(kPan));
  const cv::Mat evidence = background_.unlike(scene(kPictures * kPan));
  EXPECT_LT(mean(evidence, {20, 5, 135, 110}), 0.02);
  EXPECT_EQ(cv::countNonZero(evidence.colRange(0, 3)), 0) << "what enters is unknown, not foreground";
}

TEST_F(Background, TellsColoursOfOneGreyValueApart) {
  const cv::Mat plain(kSize, CV_8UC3, cv::Scalar(100, 100, 100));
  for (int k = 0; k < kPictures; ++k) background_.learn(plain, nothingMoves(), kFrame_s);
  cv::Mat now = plain.clone();
  // 0.114 B + 0.587 G + 0.299 R stays at 100.
  now(kPatch).setTo(cv::Scalar(100, 70, 159));
  const cv::Mat evidence = background_.unlike(now);
  EXPECT_GT(mean(evidence, {64, 54, 12, 12}), 0.6);
  EXPECT_LT(mean(evidence, {5, 5, 40, 40}), 0.01);
}

/// How foreign the uncovered place looks after something stood on it for six pictures.
double ghost(bool told_to_move) {
  CarriedBackground background{SegmentationParameters{}};
  for (int k = 0; k < kPictures; ++k) background.learn(scene(0), nothingMoves(), kFrame_s);
  cv::Mat covered = scene(0);
  covered(kPatch).setTo(cv::Scalar(10, 10, 10));
  cv::Mat moving = nothingMoves();
  moving(kPatch).setTo(told_to_move ? 1 : 0);
  for (int k = 0; k < 6; ++k) background.learn(covered, moving, kFrame_s);
  return mean(background.unlike(scene(0)), {64, 54, 12, 12});
}

TEST_F(Background, WhatMovesIsNotLearned) {
  EXPECT_LT(ghost(true), 0.5 * ghost(false));
  EXPECT_LT(ghost(true), 0.2);
}

TEST_F(Background, AChangeThatStaysBecomesBackground) {
  for (int k = 0; k < kPictures; ++k) background_.learn(scene(0), nothingMoves(), kFrame_s);
  cv::Mat parked = scene(0);
  parked(kPatch).setTo(cv::Scalar(10, 10, 10));
  EXPECT_GT(mean(background_.unlike(parked), {64, 54, 12, 12}), 0.8);
  for (int k = 0; k < 60; ++k) background_.learn(parked, nothingMoves(), kFrame_s);
  EXPECT_LT(mean(background_.unlike(parked), {64, 54, 12, 12}), 0.05);
}

TEST_F(Background, UncertainPixelsAccuseLess) {
  // The left half flickers by 30 grey levels; then both halves show the same step.
  for (int k = 0; k < 40; ++k) {
    cv::Mat now(kSize, CV_8UC3, cv::Scalar::all(100));
    now.colRange(0, 80).setTo(cv::Scalar::all(k % 2 == 0 ? 70 : 130));
    background_.learn(now, nothingMoves(), kFrame_s);
  }
  const cv::Mat evidence = background_.unlike(cv::Mat(kSize, CV_8UC3, cv::Scalar::all(150)));
  EXPECT_LT(mean(evidence, {10, 10, 60, 100}), 0.8 * mean(evidence, {90, 10, 60, 100}));
}

TEST_F(Background, AboveTheHorizonOnlyTheRotationCounts) {
  // Level flight to the right, low: the ground slides by, the sky stays.
  Eigen::Matrix3d K;
  K << 100, 0, 79.5, 0, 100, 59.5, 0, 0, 1;
  const PlaneMotion motion{Eigen::Matrix3d::Identity(), {-0.2, 0, 0}, {0, 1, 0}, 1.0};
  const SceneMotion step(planeHomography(K, motion), motion, K);
  for (int k = 0; k < kPictures; ++k) background_.learn(scene(0), nothingMoves(), kFrame_s);
  background_.carry(step);
  const cv::Mat evidence = background_.unlike(scene(0));
  EXPECT_LT(mean(evidence, {5, 5, 150, 50}), 0.01);
  EXPECT_GT(mean(evidence, {5, 100, 120, 15}), 0.2);
}

}  // namespace
}  // namespace redbee
