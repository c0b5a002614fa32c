#include "redbee/visual/sharpness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using Sharpness = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(Sharpness);

/// By OpenCV's gradients, without the border.
double expectedSharpness(const cv::Mat1b& image) {
  cv::Mat1d dx, dy;
  cv::Sobel(image, dx, CV_64F, 1, 0);
  cv::Sobel(image, dy, CV_64F, 0, 1);
  const cv::Rect inner(1, 1, image.cols - 2, image.rows - 2);
  const double scale = 1 / (64.0 * inner.area());
  const double xx = scale * dx(inner).dot(dx(inner)), xy = scale * dx(inner).dot(dy(inner)),
               yy = scale * dy(inner).dot(dy(inner));
  return 0.5 * (xx + yy) - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
}

TEST_P(Sharpness, IsThatOfOpenCvsGradientsAtAnyWidth) {
  cv::RNG random(3);
  for (const int width : {3, 4, 7, 8, 9, 17, 18, 19, 34, 320}) {
    cv::Mat1b image(12, width);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    const double expected = expectedSharpness(image);
    EXPECT_NEAR(sharpnessOf(image), expected, 1e-9 * expected) << width;
  }
}

TEST_P(Sharpness, HoldsTheSteepestGradientsOfAWideImage) {
  cv::Mat1b image(8, 1920);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) image(y, x) = ((x / 2) + (y / 2)) % 2 == 0 ? 0 : 255;
  }
  const double expected = expectedSharpness(image);
  EXPECT_NEAR(sharpnessOf(image), expected, 1e-9 * expected);
}

TEST_P(Sharpness, OfAnEdgeInOneDirectionIsNone) {
  cv::Mat1b image(32, 48, static_cast<uchar>(10));
  image.colRange(20, 48) = 200;
  EXPECT_NEAR(sharpnessOf(image), 0, 1e-9);
  EXPECT_EQ(sharpnessOf({}), 0);
}

}  // namespace
}  // namespace redbee::test
