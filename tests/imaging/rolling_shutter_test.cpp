// Simulated images of a rolling shutter, rectified by their true motion, against those of a global shutter at
// the same pose.
#include <gtest/gtest.h>

#include <iostream>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/image_row_motion.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/simulation/scenarios.hpp"

namespace redbee::test {
namespace {

constexpr int kFrame = 20;
constexpr double kReadout_s = 0.025;

simulation::Scenario scenario() {
  simulation::Scenario s = simulation::briskWalkers(3);
  s.sensor.noise_sigma = 0;
  return s;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b, const cv::Mat1b& where) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return cv::mean(difference, where)[0];
}

class RollingShutterRectifier : public testing::TestWithParam<CameraIntrinsics> {};

TEST_P(RollingShutterRectifier, ImagesBecomeThoseOfAGlobalShutter) {
  simulation::Scenario still = scenario();
  still.intrinsics = GetParam();
  const simulation::FlightSimulator global(still), rolling(withRollingShutter(still, kReadout_s));
  const RowMotion motion = rolling.rowMotion(kFrame);
  const Rectifier lens(global.camera()), rectifier(rolling.camera());
  const simulation::RenderedImage truth = global.frame(kFrame).image, image = rolling.frame(kFrame).image;
  const cv::Mat1b ideal_truth = lens.toIdeal(truth.grey);
  cv::Mat1b inside = rectifier.ownParts({motion}) == 0;
  cv::erode(inside, inside, cv::Mat::ones(5, 5, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  const double corrected = meanDifference(rectifier.toIdeal(image.grey, {motion}), ideal_truth, inside);
  const double uncorrected = meanDifference(rectifier.toIdeal(image.grey), ideal_truth, inside);
  std::cout << "mean grey difference " << corrected << ", uncorrected " << uncorrected << '\n';
  EXPECT_LT(corrected, uncorrected / 5);

  // Labels go back to where the rolling shutter has them.
  const cv::Mat1b mask = truth.id != 0, raw_truth = image.id != 0;
  const cv::Mat1b ideal_mask = lens.toIdeal(mask) > 127;
  const auto differing = [&](const cv::Mat1b& raw) { return cv::countNonZero(raw != raw_truth); };
  ASSERT_GT(cv::countNonZero(raw_truth), 500);
  const int back = differing(rectifier.toRaw(ideal_mask, 0, {motion})),
            without = differing(rectifier.toRaw(ideal_mask));
  std::cout << back << " px of the labels differ, uncorrected " << without << ", of "
            << cv::countNonZero(raw_truth) << '\n';
  EXPECT_LT(back, without / 2);
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, RollingShutterRectifier,
    testing::Values(CameraIntrinsics{640, 480, 500, 500, 319.5, 239.5, {}},
                    CameraIntrinsics{
                        640, 480, 305, 305, 319.5, 239.5, {-0.018, 0.0075, -0.0042, 0.0006}, "equidistant"}));

TEST(RollingShutterRectifier, WithoutMotionOrLineDelayNothingChanges) {
  CameraIntrinsics camera{64, 48, 50, 50, 31.5, 23.5, {}};
  RowMotion motion;
  motion.rate = {0.5, 0.5, 0.5};
  const cv::Mat1b image(48, 64, uchar{7});
  EXPECT_EQ(Rectifier(Camera(camera)).toIdeal(image, {motion}).data, image.data) << "global shutter";
  camera.line_delay_s = 1e-4;
  EXPECT_EQ(Rectifier(Camera(camera)).toIdeal(image).data, image.data) << "motion unknown";
}

TEST(RollingShutterRectifier, WhatTheMotionTakesBeyondTheBorderIsNotShown) {
  CameraIntrinsics camera{640, 480, 500, 500, 319.5, 239.5, {}};
  camera.line_delay_s = kReadout_s / 480;
  RowMotion motion;
  motion.rate = {0, 1, 0};  // to the right: at the edges the last row sees 9 px further
  const Rectifier rectifier{Camera(camera)};
  const cv::Mat1b parts = rectifier.ownParts({motion});
  EXPECT_EQ(parts(470, 1), 255) << "was out of view when the last row was exposed";
  EXPECT_EQ(parts(470, 14), 0);
  EXPECT_EQ(parts(240, 1), 0);
  EXPECT_EQ(parts(9, 638), 255);
  EXPECT_EQ(parts(9, 1), 0);
  EXPECT_TRUE(rectifier.ownParts().empty());
}

TEST(ImageRowMotion, ARepeatedImageWasExposedWhenTheFirstWas) {
  cv::Mat1b first(96, 128), second(96, 128);
  cv::RNG random(1);
  random.fill(first, cv::RNG::UNIFORM, 0, 255);
  random.fill(second, cv::RNG::UNIFORM, 0, 255);
  RowMotion slow, fast;
  slow.rate = {0.1, 0, 0};
  fast.rate = {1, 0, 0};
  ImageRowMotion motion;
  EXPECT_EQ(motion.of(first, slow)->rate, slow.rate);
  EXPECT_EQ(motion.of(first, fast)->rate, slow.rate) << "repeated";
  EXPECT_EQ(motion.of(second, fast)->rate, fast.rate);
  EXPECT_FALSE(motion.of(second, std::nullopt));
}

}  // namespace
}  // namespace redbee::test
