#include "redbee/detection/image_check.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/detection/parameters.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

TEST(ImageCheck, RefusesNoiseAndKeepsANoisyScene) {
  ImageCheck check{DetectionParameters{}.min_contrast};
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
  ImageCheck check{DetectionParameters{}.min_contrast};
  // Blurred, since pure noise is no image either.
  const auto scene = [](int seed) {
    cv::Mat image;
    cv::GaussianBlur(noiseImage({64, 48}, seed, 120, 60), image, cv::Size(), 1.5);
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
}  // namespace redbee::test
