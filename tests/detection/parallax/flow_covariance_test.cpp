#include "redbee/detection/parallax/flow_covariance.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr FlowNoise kNoise{0.5, 8};
constexpr int kSide = 96;

/// A ramp, `scale` times smaller than the full image: its gradient is (slope_x, slope_y) everywhere, in grey
/// levels per px of the quarter-size image.
cv::Mat1b ramp(double slope_x, double slope_y, double scale = 1) {
  const double quarter = 4 / scale;
  cv::Mat1b image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      image(y, x) = cv::saturate_cast<uchar>(10 + (slope_x * x + slope_y * y) / quarter);
  }
  return image;
}

Symmetric2f inTheMiddle(const cv::Mat1b& image, double scale = 1) {
  return FlowTexture(image, scale).covariance(kNoise)(image.rows / 2, image.cols / 4);
}

TEST(FlowCovariance, AcrossAnEdgeTheVarianceDoublesAtMinGradient) {
  const Symmetric2f C = inTheMiddle(ramp(kNoise.min_gradient, 0));
  const double variance = kNoise.sigma_px * kNoise.sigma_px;
  EXPECT_NEAR(C[0], 2 * variance, 0.15 * variance) << "grey levels are whole";
  EXPECT_GT(C[2], 1000 * variance) << "along the edge nothing is observed";
}

TEST(FlowCovariance, TurnsWithTheEdge) {
  const Symmetric2f across_x = inTheMiddle(ramp(6, 0)), across_y = inTheMiddle(ramp(0, 6));
  EXPECT_NEAR(across_y[2], across_x[0], 1e-3 * across_x[0]);
  EXPECT_NEAR(across_y[0], across_x[2], 1e-3 * across_x[2]);
  const Symmetric2f diagonal = inTheMiddle(ramp(4, 4));
  EXPECT_NEAR(diagonal[0], diagonal[2], 1e-2 * diagonal[0]);
  EXPECT_LT(diagonal[1], -0.9 * diagonal[0]) << "errors along the edge go up in x and down in y";
}

TEST(FlowCovariance, ASmallerImageHasLargerPixels) {
  constexpr double kScale = 2;
  const Symmetric2f C = inTheMiddle(ramp(6, 0), 1);
  const Symmetric2f half = inTheMiddle(ramp(6, 0, kScale), kScale);
  EXPECT_NEAR(half[0], C[0] / (kScale * kScale), 0.1 * C[0]) << "in its own pixels";
}

TEST(FlowCovariance, WithoutTextureItIsFiniteAndLarge) {
  const Symmetric2f C = inTheMiddle(cv::Mat1b(kSide, kSide, uchar(90)));
  EXPECT_GT(C[0], 1e3);
  EXPECT_LT(C[0], 1e6);
  EXPECT_NEAR(C[1], 0, 1e-6);
}

TEST(FlowCovariance, TheLargestVarianceIsThatAlongTheEdge) {
  const cv::Mat3f covariance(1, 2, Symmetric2f(12.625F, 12.375F, 12.625F));
  EXPECT_NEAR(FlowCovariance(covariance, covariance.size()).largest(0, 1), 25, 1e-4);
}

/// The scalar reference: cv::resize().
TEST(FlowCovariance, IsInterpolatedAsByOpenCv) {
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(128, 96), cv::Size(256, 192), cv::Size(131, 95)}) {
    cv::Mat3f map(48, 64), resized;
    cv::RNG(5).fill(map, cv::RNG::UNIFORM, 0, 100);
    cv::resize(map, resized, size, 0, 0, cv::INTER_LINEAR);
    FlowCovariance covariance(map, size);
    for (int y = 0; y < size.height; ++y) {
      const FlowCovariance::Rows rows = covariance.rows(y);
      for (int x = 0; x < size.width; ++x) {
        const auto value = [&](int i) {
          return rows.upper[i][x] * rows.upper_weight + rows.lower[i][x] * rows.lower_weight;
        };
        ASSERT_EQ(resized(y, x), covariance(y, x));
        ASSERT_EQ(resized(y, x), Symmetric2f(value(0), value(1), value(2)));
      }
    }
  }
}

}  // namespace
}  // namespace redbee
