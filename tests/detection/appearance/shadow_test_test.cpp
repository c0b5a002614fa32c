#include "redbee/detection/appearance/shadow_test.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

constexpr double kNoise = 8;
const cv::Size kSize(24, 18);

/// A checked floor.
cv::Mat4f floor() {
  cv::Mat4f image(kSize);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const float check = (x / 2 + y / 2) % 2 == 0 ? 1.0F : 0.8F;
      image(y, x) = cv::Vec4f(90, 120, 150, 0) * check;
    }
  }
  return image;
}

/// Least and greatest answer over the image.
std::pair<float, float> extremes(const cv::Mat4b& image) {
  FloatRows rows(image);
  ShadowTest test(rows, floor(), kNoise);
  float least = 1, greatest = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (const float shadow : test.row(y)) {
      least = std::min(least, shadow);
      greatest = std::max(greatest, shadow);
    }
  }
  return {least, greatest};
}

TEST(ShadowTest, AFloorInShadeIsInShadowUpToItsBorders) {
  EXPECT_GT(extremes(0.7 * floor()).first, 0.99F);
  EXPECT_GT(extremes(0.55 * floor()).first, 0.99F);
}

TEST(ShadowTest, TheSameLightMoreLightAndNearDarknessAreNoShadow) {
  EXPECT_EQ(extremes(floor()).second, 0);
  EXPECT_EQ(extremes(1.3 * floor()).second, 0);
  EXPECT_EQ(extremes(0.2 * floor()).second, 0);
}

TEST(ShadowTest, AnotherColourIsNoShadow) {
  EXPECT_LT(extremes(cv::Mat4b(kSize, cv::Vec4b(110, 60, 60, 0))).second, 0.1F);
}

TEST(ShadowTest, ShadeOfAnotherTextureIsNoShadow) {
  // Two pixels aside the checks are each other's negative.
  const cv::Mat4b shade = 0.7 * floor();
  cv::Mat4b moved = shade.clone();
  const int width = kSize.width - 2;
  shade(cv::Rect(0, 0, width, kSize.height)).copyTo(moved(cv::Rect(2, 0, width, kSize.height)));
  EXPECT_LT(extremes(moved).first, 0.5F);
}

TEST(ShadowTest, AnImageOfOneColumnIsClassified) {
  const cv::Mat4b column = 0.7 * floor().colRange(0, 1);
  FloatRows rows(column);
  ShadowTest test(rows, floor().colRange(0, 1).clone(), kNoise);
  for (int y = 0; y < column.rows; ++y) EXPECT_GT(test.row(y)[0], 0.99F);
}

}  // namespace
}  // namespace redbee
