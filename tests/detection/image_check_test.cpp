#include "redbee/detection/image_check.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/detection/parameters.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

constexpr int kDownscale = 2;

// Blurred, since pure noise is no image either.
cv::Mat1b scene(unsigned seed) {
  cv::Mat image;
  cv::GaussianBlur(noiseImage({64, 48}, seed, 120, 60), image, cv::Size(), 1.5);
  return image;
}

ImageCheck checkAfter(const cv::Mat1b& reference) {
  ImageCheck check{DetectionParameters{}.min_contrast};
  check.setReference(reference);
  return check;
}

TEST(ImageCheck, RefusesNoiseAndKeepsANoisyScene) {
  const ImageCheck check{DetectionParameters{}.min_contrast};
  cv::RNG random(3);
  cv::Mat noise(240, 320, CV_8U);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_EQ(check.classify(noise, kDownscale), ImageContent::kUnusable)
      << "its neighbours have nothing to do with each other";
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, cv::Size(), 2);
  cv::Mat grain(smooth.size(), CV_8U);
  random.fill(grain, cv::RNG::UNIFORM, 0, 10);
  EXPECT_EQ(check.classify(smooth + grain, kDownscale), ImageContent::kNew)
      << "a dark scene of little contrast, the sensor's grain on it";
}

TEST(ImageCheck, RefusesBlankImages) {
  const ImageCheck check = checkAfter(scene(1));
  EXPECT_EQ(check.classify(cv::Mat(48, 64, CV_8U, cv::Scalar(0)), kDownscale), ImageContent::kUnusable);
  EXPECT_EQ(check.classify(cv::Mat(48, 64, CV_8U, cv::Scalar(255)), kDownscale), ImageContent::kUnusable);
  EXPECT_EQ(check.classify(cv::Mat(), kDownscale), ImageContent::kUnusable);
  EXPECT_EQ(check.classify(scene(2), kDownscale), ImageContent::kNew);
}

TEST(ImageCheck, TellsRepeatedImages) {
  const ImageCheck check = checkAfter(scene(1));
  EXPECT_EQ(check.classify(scene(1), kDownscale), ImageContent::kFrozen);
  cv::Mat1b again = scene(1);
  for (int y = 0; y < again.rows; ++y) {
    for (int x = y % 3; x < again.cols; x += 3) ++again(y, x);
  }
  EXPECT_EQ(check.classify(again, kDownscale), ImageContent::kRepeated)
      << "by less than encoding twice changes";
  cv::Mat1b other = scene(1);
  other(cv::Rect(20, 10, 4, 4)) += 10;
  EXPECT_EQ(check.classify(other, kDownscale), ImageContent::kNew) << "something moved within a block";
  EXPECT_EQ(check.classify(scene(1)(cv::Rect(0, 0, 32, 48)), kDownscale), ImageContent::kNew)
      << "another size";
}

}  // namespace
}  // namespace redbee::test
