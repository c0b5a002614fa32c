#include "redbee/detection/parallax/textured_pixels.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kWindow_px = 7, kCell_px = 8;
constexpr float kLeast = 10;

/// Noise that is smooth enough to be texture; plain to the right.
cv::Mat1b texture() {
  cv::Mat1b image(61, 85);
  cv::RNG(4).fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, {0, 0}, 1.5);
  image.colRange(60, image.cols).setTo(90);
  return image;
}

TEST(TexturedPixels, TensorsAroundPointsAreThoseOfTheImage) {
  const cv::Mat1b image = texture();
  const cv::Mat3f tensors = structureTensor(image, kWindow_px);
  const std::vector<cv::Point> points{{0, 0}, {84, 60}, {30, 20}, {12, 20}, {30, 20}, {5, 59}};
  TexturedPixels pixels(kWindow_px, kCell_px, kLeast);
  for (int twice = 0; twice < 2; ++twice) {
    pixels.find(image, points);
    ASSERT_EQ(pixels.atPoints().size(), points.size());
    for (size_t i = 0; i < points.size(); ++i)
      EXPECT_EQ(pixels.atPoints()[i], tensors(points[i])) << points[i];
  }
}

TEST(TexturedPixels, TheBestOfEachCellWithoutAPoint) {
  const cv::Mat1b image = texture();
  const cv::Mat3f tensors = structureTensor(image, kWindow_px);
  const cv::Point taken(3 * kCell_px + 1, 2 * kCell_px + 7), beside(84, 60);  // the latter in no whole cell
  std::vector<cv::Point> best;
  for (int row = 0; row < image.rows / kCell_px; ++row) {
    for (int column = 0; column < image.cols / kCell_px; ++column) {
      if (cv::Point(column, row) == cv::Point(3, 2)) continue;
      float most = kLeast;
      cv::Point at(-1, -1);
      for (int y = row * kCell_px; y < (row + 1) * kCell_px; ++y) {
        for (int x = column * kCell_px; x < (column + 1) * kCell_px; ++x) {
          if (smallestEigenvalue(tensors(y, x)) <= most) continue;
          most = smallestEigenvalue(tensors(y, x));
          at = {x, y};
        }
      }
      if (at.x >= 0) best.push_back(at);
    }
  }
  TexturedPixels pixels(kWindow_px, kCell_px, kLeast);
  pixels.find(image, {taken, beside});
  EXPECT_EQ(pixels.best(), best);
  EXPECT_GT(best.size(), 30u);
  EXPECT_LT(best.size(), 69u) << "plain cells have none";
}

}  // namespace
}  // namespace redbee
