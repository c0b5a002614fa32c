#include "redbee/detection/two_planes/background_model.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/detection/image_check.hpp"

namespace redbee {
namespace {

cv::Mat noise(cv::Size size, int seed, double mean, double sigma) {
  cv::Mat image(size, CV_8U);
  cv::RNG rng(static_cast<uint64_t>(seed));
  rng.fill(image, cv::RNG::NORMAL, mean, sigma);
  return image;
}

TEST(GaussianMixture, LearnsTwoValuesAndSeesAThird) {
  GaussianMixture mixture({1, 1}, 50, 16);
  const cv::Mat valid(1, 1, CV_8U, cv::Scalar(255));
  const auto see = [&](int value) {
    return mixture.update(cv::Mat(1, 1, CV_8U, cv::Scalar(value)), valid).at<uint8_t>(0);
  };
  for (int k = 0; k < 60; ++k) see(k % 2 == 0 ? 60 : 160);
  EXPECT_EQ(see(60), 0);
  EXPECT_EQ(see(160), 0);
  EXPECT_EQ(see(110), 255);
}

TEST(GaussianMixture, ForgetsWhatIsNoLongerThere) {
  GaussianMixture mixture({1, 1}, 20, 16);
  const cv::Mat valid(1, 1, CV_8U, cv::Scalar(255));
  const auto see = [&](int value) {
    return mixture.update(cv::Mat(1, 1, CV_8U, cv::Scalar(value)), valid).at<uint8_t>(0);
  };
  for (int k = 0; k < 40; ++k) see(60);
  EXPECT_EQ(see(160), 255);
  for (int k = 0; k < 200; ++k) see(160);
  EXPECT_EQ(see(160), 0);
  EXPECT_EQ(see(60), 255);
}

class CanvasMargin : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(CarriedAndAnchored, CanvasMargin, ::testing::Values(0.0, 0.125));

TEST_P(CanvasMargin, FollowsAPanAndKnowsWhatItHasNotSeen) {
  const cv::Mat world = noise({400, 60}, 1, 120, 20);
  SegmentationParameters parameters;
  parameters.canvas_margin = GetParam();
  constexpr int kStep = 3;
  const cv::Size view(100, 60);
  BackgroundModel model(view, parameters);
  Eigen::Matrix3d pan = Eigen::Matrix3d::Identity();
  pan(0, 2) = -kStep;
  BackgroundVerdict verdict;
  for (int k = 0; k < 40; ++k) {
    if (k > 0) model.carry(pan);
    cv::Mat image = world(cv::Rect(kStep * k, 0, view.width, view.height)).clone();
    if (k == 39) image(cv::Rect(40, 20, 10, 10)).setTo(255);
    verdict = model.learn(image);
  }
  const int fresh = kStep * parameters.learning_frames;
  EXPECT_EQ(cv::countNonZero(verdict.unknown), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(verdict.unknown.colRange(view.width - fresh, view.width)), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(verdict.foreground), 100);
  EXPECT_EQ(cv::countNonZero(verdict.foreground(cv::Rect(40, 20, 10, 10))), 100);
}

TEST(ImageCheck, RefusesNoiseAndKeepsANoisyScene) {
  ImageCheck check{SegmentationParameters{}};
  cv::RNG random(3);
  cv::Mat noise(240, 320, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_FALSE(check.accepts(noise)) << "its neighbours have nothing to do with each other";
  cv::Mat scene;
  cv::GaussianBlur(noise, scene, cv::Size(), 2);
  cv::Mat grain(scene.size(), CV_8U);
  random.fill(grain, cv::RNG::UNIFORM, 0, 10);
  EXPECT_TRUE(check.accepts(scene + grain)) << "a dark scene of little contrast, the sensor's grain on it";
}

TEST(ImageCheck, RefusesBlankAndFrozenImages) {
  ImageCheck check{SegmentationParameters{}};
  // Blurred, since pure noise is no image either.
  const auto scene = [](int seed) {
    cv::Mat image;
    cv::GaussianBlur(noise({64, 48}, seed, 120, 60), image, cv::Size(), 1.5);
    return image;
  };
  const cv::Mat good = scene(1);
  EXPECT_TRUE(check.accepts(good));
  EXPECT_FALSE(check.accepts(good));
  EXPECT_FALSE(check.accepts(cv::Mat(48, 64, CV_8U, cv::Scalar(0))));
  EXPECT_FALSE(check.accepts(cv::Mat(48, 64, CV_8U, cv::Scalar(255))));
  EXPECT_FALSE(check.accepts(cv::Mat()));
  EXPECT_TRUE(check.accepts(scene(2)));
}

}  // namespace
}  // namespace redbee
