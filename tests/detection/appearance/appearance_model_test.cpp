#include "redbee/detection/appearance/appearance_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kFrame_s = 0.04;
constexpr int kImages = 12;
const cv::Size kSize(160, 120);
const cv::Rect kPatch(60, 50, 20, 20);

cv::Mat asLearned(const cv::Mat& bgr) {
  cv::Mat image;
  cv::cvtColor(bgr, image, cv::COLOR_BGR2BGRA);
  return image;
}

cv::Mat plain(const cv::Scalar& bgr) { return asLearned(cv::Mat(kSize, CV_8UC3, bgr)); }

cv::Scalar opaque(double blue, double green, double red) { return {blue, green, red, 255}; }

/// Smooth colours, so that resampling costs no more than a few grey levels.
cv::Mat scene(double shift_x) {
  cv::Mat image(kSize, CV_8UC3);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double u = x - shift_x;
      image.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uint8_t>(120 + 40 * std::sin(u / 9)),
                                   cv::saturate_cast<uint8_t>(120 + 40 * std::cos(y / 11.0)),
                                   cv::saturate_cast<uint8_t>(120 + 40 * std::sin((u + y) / 13))};
    }
  }
  return asLearned(image);
}

/// Every surface at this speed [px], known to within 0.1 px.
SurfaceSpeed allAt(double speed) { return {kSize, cv::Vec2f(static_cast<float>(speed), 0.01F)}; }

cv::Mat nothingMoves() { return cv::Mat::zeros(kSize, CV_32F); }

SceneMotion pan(double px) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = px;
  return {H, std::nullopt, Eigen::Matrix3d::Identity()};
}

double mean(const cv::Mat& map, const cv::Rect& where) { return cv::mean(map(where))[0]; }

class Background : public testing::Test {
 protected:
  AppearanceModel background_{AppearanceParameters{}, ShadowParameters{},
                              ParallaxParameters{}.evidence_sigmas};
  SpareMaps spare_;
};

TEST_F(Background, IsUnknownAtFirst) {
  EXPECT_EQ(cv::countNonZero(background_.appearanceDifference(scene(0), allAt(0))), 0);
}

TEST_F(Background, FollowsAPanAndMarksUnknownPixels) {
  constexpr double kPan = 3.4;
  for (int k = 0; k < kImages; ++k) {
    background_.propagate(pan(kPan), spare_);
    background_.learn(scene(k * kPan), nothingMoves(), allAt(0), kFrame_s);
  }
  background_.propagate(pan(kPan), spare_);
  const cv::Mat evidence = background_.appearanceDifference(scene(kImages * kPan), allAt(0));
  EXPECT_LT(mean(evidence, {20, 5, 135, 110}), 0.02);
  EXPECT_EQ(cv::countNonZero(evidence.colRange(0, 3)), 0) << "what enters is unknown, not foreground";
}

TEST_F(Background, DistinguishesColoursOfOneGreyValue) {
  const cv::Mat grey = plain({100, 100, 100});
  for (int k = 0; k < kImages; ++k) background_.learn(grey, nothingMoves(), allAt(0), kFrame_s);
  cv::Mat now = grey.clone();
  // 0.114 B + 0.587 G + 0.299 R stays at 100.
  now(kPatch).setTo(opaque(100, 70, 159));
  const cv::Mat evidence = background_.appearanceDifference(now, allAt(0));
  EXPECT_GT(mean(evidence, {64, 54, 12, 12}), 0.6);
  EXPECT_LT(mean(evidence, {5, 5, 40, 40}), 0.01);
}

/// Appearance difference of an uncovered place after an object stood there for six images.
double ghost(bool told_to_move) {
  AppearanceModel background{AppearanceParameters{}, ShadowParameters{},
                             ParallaxParameters{}.evidence_sigmas};
  for (int k = 0; k < kImages; ++k) background.learn(scene(0), nothingMoves(), allAt(0), kFrame_s);
  cv::Mat covered = scene(0);
  covered(kPatch).setTo(opaque(10, 10, 10));
  cv::Mat moving = nothingMoves();
  moving(kPatch).setTo(told_to_move ? 1 : 0);
  for (int k = 0; k < 6; ++k) background.learn(covered, moving, allAt(0), kFrame_s);
  return mean(background.appearanceDifference(scene(0), allAt(0)), {64, 54, 12, 12});
}

TEST_F(Background, MovingPixelsAreNotLearned) {
  EXPECT_LT(ghost(true), 0.5 * ghost(false));
  EXPECT_LT(ghost(true), 0.2);
}

TEST_F(Background, AChangeThatStaysBecomesBackground) {
  for (int k = 0; k < kImages; ++k) background_.learn(scene(0), nothingMoves(), allAt(0), kFrame_s);
  cv::Mat parked = scene(0);
  parked(kPatch).setTo(opaque(10, 10, 10));
  EXPECT_GT(mean(background_.appearanceDifference(parked, allAt(0)), {64, 54, 12, 12}), 0.8);
  for (int k = 0; k < 60; ++k) background_.learn(parked, nothingMoves(), allAt(0), kFrame_s);
  EXPECT_LT(mean(background_.appearanceDifference(parked, allAt(0)), {64, 54, 12, 12}), 0.05);
}

TEST_F(Background, UncertainPixelsDifferLess) {
  // The left half flickers by 30 grey levels; then both halves show the same step.
  for (int k = 0; k < 40; ++k) {
    cv::Mat now = plain(cv::Scalar::all(100));
    now.colRange(0, 80).setTo(cv::Scalar::all(k % 2 == 0 ? 70 : 130));
    background_.learn(now, nothingMoves(), allAt(0), kFrame_s);
  }
  const cv::Mat evidence = background_.appearanceDifference(plain(cv::Scalar::all(150)), allAt(0));
  EXPECT_LT(mean(evidence, {10, 10, 60, 100}), 0.8 * mean(evidence, {90, 10, 60, 100}));
}

/// Appearance difference of the ground after a post of this speed has left it. `known_px`: sigma of the
/// ground's own speed.
double foreignAfterPost(double post_speed, double known_px, int images_later) {
  AppearanceModel background{AppearanceParameters{}, ShadowParameters{},
                             ParallaxParameters{}.evidence_sigmas};
  cv::Mat with_post = scene(0);
  with_post(kPatch).setTo(opaque(10, 10, 10));
  SurfaceSpeed speed = allAt(0);
  speed(kPatch).setTo(cv::Scalar(post_speed, 0.01));
  for (int k = 0; k < kImages; ++k) background.learn(with_post, nothingMoves(), speed, kFrame_s);
  SurfaceSpeed ground = allAt(0);
  ground(kPatch).setTo(cv::Scalar(0, known_px * known_px));
  for (int k = 0; k < images_later; ++k) background.learn(scene(0), nothingMoves(), ground, kFrame_s);
  return mean(background.appearanceDifference(scene(0), ground), {64, 54, 12, 12});
}

TEST_F(Background, UncoveredGroundIsNotForeground) {
  EXPECT_GT(foreignAfterPost(0, 0.1, 0), 0.8) << "what stood still is the background";
  EXPECT_LT(foreignAfterPost(2, 0.1, 0), 0.1);
  EXPECT_LT(foreignAfterPost(2, 0.1, 1), 0.01) << "one image teaches it";
}

TEST_F(Background, APlainSurfaceWhoseSpeedIsNotKnownDoesNotUncover) {
  EXPECT_GT(foreignAfterPost(2, 10, 0), 0.6);
}

TEST_F(Background, AShadowIsBackground) {
  for (int k = 0; k < kImages; ++k) background_.learn(scene(0), nothingMoves(), allAt(0), kFrame_s);
  cv::Mat shaded = scene(0);
  shaded(kPatch) *= 0.6;
  cv::Mat painted = scene(0);
  painted(kPatch).setTo(opaque(60, 90, 30));
  EXPECT_LT(mean(background_.appearanceDifference(shaded, allAt(0)), {64, 54, 12, 12}), 0.05);
  EXPECT_GT(mean(background_.appearanceDifference(painted, allAt(0)), {64, 54, 12, 12}), 0.5);
}

TEST_F(Background, AMisalignedEdgeDiffersLessThanASurface) {
  // Half of the step's 150 grey levels, in the column beside it and over a surface.
  cv::Mat step = plain(cv::Scalar::all(50));
  step.colRange(80, kSize.width).setTo(cv::Scalar::all(200));
  for (int k = 0; k < kImages; ++k) background_.learn(step, nothingMoves(), allAt(0), kFrame_s);
  cv::Mat now = step.clone();
  now.col(79).setTo(cv::Scalar::all(125));
  now.colRange(20, 40).setTo(cv::Scalar::all(125));
  const cv::Mat evidence = background_.appearanceDifference(now, allAt(0));
  EXPECT_LT(mean(evidence, {79, 10, 1, 100}), 0.4);
  EXPECT_GT(mean(evidence, {22, 10, 16, 100}), 0.8);
}

TEST_F(Background, AboveTheHorizonOnlyTheRotationCounts) {
  // Low level flight to the right: the ground moves, the sky does not.
  Eigen::Matrix3d K;
  K << 100, 0, 79.5, 0, 100, 59.5, 0, 0, 1;
  const PlaneMotion motion{Eigen::Matrix3d::Identity(), {-0.2, 0, 0}, {0, 1, 0}, 1.0};
  const SceneMotion step(planeHomography(K, motion), motion, K);
  for (int k = 0; k < kImages; ++k) background_.learn(scene(0), nothingMoves(), allAt(0), kFrame_s);
  background_.propagate(step, spare_);
  const cv::Mat evidence = background_.appearanceDifference(scene(0), allAt(0));
  EXPECT_LT(mean(evidence, {5, 5, 150, 50}), 0.01);
  EXPECT_GT(mean(evidence, {5, 100, 120, 15}), 0.2);
}

}  // namespace
}  // namespace redbee
