#include "redbee/detection/parallax/photometric_gain.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace redbee {
namespace {

const cv::Size kImage(64, 48);
constexpr int kSlope = 3;                                // grey levels per px, along x
constexpr double kNoise = 6, kNoise2 = kNoise * kNoise;  // grey levels
const cv::Rect kInside(16, 12, 24, 16);

/// Rows of one vector.
std::function<const cv::Vec2f*(int)> everywhere(const cv::Vec2f& vector) {
  return
      [row = std::vector<cv::Vec2f>(static_cast<size_t>(kImage.width), vector)](int) { return row.data(); };
}

/// The earlier image is a ramp; in the current one all of it lies `moved_px` further to the right.
ImagePair rampMovedBy(int moved_px, int slope = kSlope) {
  ImagePair images{cv::Mat1b(kImage), cv::Mat1b(kImage), cv::Mat2f(kImage, {0, 0}), everywhere({0, 0}),
                   HomographyFlow(kImage)};
  for (int y = 0; y < kImage.height; ++y) {
    for (int x = 0; x < kImage.width; ++x) {
      images.earlier(y, x) = cv::saturate_cast<uchar>(20 + slope * x);
      images.current(y, x) = cv::saturate_cast<uchar>(20 + slope * (x - moved_px));
    }
  }
  return images;
}

double gainInside(const ImagePair& images) {
  return cv::mean(photometricGain(images, cv::Mat1b(kImage, 255), kNoise)(kInside))[0];
}

TEST(PhotometricGain, IsTheSquaredDifferenceThatOnlyTheFlowExplains) {
  ImagePair images = rampMovedBy(4);
  images.flow.setTo(cv::Scalar(-4, 0));
  EXPECT_NEAR(gainInside(images), 4 * kSlope * 4 * kSlope / kNoise2, 1e-3);
  images.flow.setTo(cv::Scalar(-3.5, 0));  // between the pixels, and not quite right
  const double wrong = kSlope * kSlope * 0.5 * 0.5;
  EXPECT_NEAR(gainInside(images), (4 * kSlope * 4 * kSlope - wrong) / (kNoise2 + wrong), 1e-3);
}

TEST(PhotometricGain, IsNoneWhereTheGroundExplainsTheImage) {
  ImagePair images = rampMovedBy(0);
  images.flow.setTo(cv::Scalar(0, 4));  // along the ramp, explains it as well
  images.nearest = everywhere({2, 0});
  EXPECT_EQ(gainInside(images), 0) << "the segment's nearest point alone would have one of 1";
}

TEST(PhotometricGain, IsNoneWhereASurfaceWithParallaxDoes) {
  ImagePair images = rampMovedBy(4);
  images.flow.setTo(cv::Scalar(-4, 3));
  images.nearest = everywhere({4, 0});
  EXPECT_NEAR(gainInside(images), 0, 1e-3);
}

TEST(PhotometricGain, TakesTheRegistrationErrorOut) {
  ImagePair images = rampMovedBy(4);
  images.flow.setTo(cv::Scalar(-4, 0));
  images.ground.affine(0, 2) = 3;  // the ground itself is 3 px off
  EXPECT_NEAR(gainInside(images), kSlope * kSlope / kNoise2, 1e-3);
  images.ground.affine(0, 2) = 4;
  EXPECT_NEAR(gainInside(images), 0, 1e-3);
}

TEST(PhotometricGain, IsNoneOnAPlainSurfaceWhateverTheFlow) {
  ImagePair images = rampMovedBy(4, 0);
  images.flow.setTo(cv::Scalar(-4, 0));
  EXPECT_EQ(gainInside(images), 0);
}

TEST(PhotometricGain, IsComputedOnlyWhereAsked) {
  ImagePair images = rampMovedBy(4);
  images.flow.setTo(cv::Scalar(-4, 0));
  cv::Mat1b where = cv::Mat1b::zeros(kImage);
  where(kInside).setTo(255);
  const cv::Mat1f gain = photometricGain(images, where, kNoise);
  EXPECT_EQ(cv::countNonZero(gain != kNotCompared), kInside.area());
  EXPECT_NEAR(gain(kInside.y, kInside.x), 4 * kSlope * 4 * kSlope / kNoise2, 1e-3)
      << "its window is whole at the edge";
}

TEST(PhotometricGain, FlowOutOfTheImageIsHeldAtTheBorder) {
  ImagePair images = rampMovedBy(0);
  images.current.setTo(20);  // as the left border is
  images.flow.setTo(cv::Scalar(-1000, 1e6));
  const cv::Mat1f gain = photometricGain(images, cv::Mat1b(kImage, 255), kNoise);
  const int x = 20;
  EXPECT_NEAR(gain(24, x), kSlope * kSlope * (x * x + 2.0 / 3) / kNoise2, 1e-3) << "mean of 3x3 pixels";
}

TEST(PhotometricGain, IsFiniteWhateverFlowAndNoise) {
  ImagePair images = rampMovedBy(0, 0);
  for (const double flow : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    images.flow.setTo(cv::Scalar::all(flow));
    for (const double noise : {1e-30, 1e30})
      EXPECT_TRUE(cv::checkRange(photometricGain(images, cv::Mat1b(kImage, 255), noise)));
  }
}

}  // namespace
}  // namespace redbee
