// Against OpenCV's exact distance transform.
#include "redbee/imaging/chamfer_distance.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

cv::Mat1b blob() {
  cv::Mat1b pixels = cv::Mat1b::zeros(14, 22);
  cv::ellipse(pixels, {{11, 7}, {20, 9}, 15}, cv::Scalar(255), cv::FILLED);
  pixels(cv::Rect(9, 5, 3, 3)).setTo(0);
  return pixels;
}

void expectWithin(const cv::Mat1f& distance, const cv::Mat1f& exact, double relative) {
  for (int y = 0; y < exact.rows; ++y) {
    for (int x = 0; x < exact.cols; ++x)
      EXPECT_NEAR(distance(y, x), exact(y, x), relative * exact(y, x)) << x << "," << y;
  }
}

TEST(ChamferDistance, IsThatFromTheRegion) {
  const cv::Mat1b pixels = blob();
  const cv::Rect box({9, 10}, pixels.size());
  cv::Mat1b outside(40, 50, uint8_t{255});
  outside(box).setTo(0, pixels);
  cv::Mat1f exact, distance(outside.size());
  cv::distanceTransform(outside, exact, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  distanceOutside(box, pixels, distance);
  expectWithin(distance, exact, 0.06);
}

TEST(ChamferDistance, IsThatFromWhatIsNotTheRegion) {
  const cv::Mat1b pixels = blob();
  cv::Mat1b padded;
  cv::copyMakeBorder(pixels, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat1f exact, distance(pixels.size());
  cv::distanceTransform(padded, exact, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  distanceInside(pixels, distance);
  expectWithin(distance, exact(cv::Rect({1, 1}, pixels.size())), 0.06);
}

TEST(ChamferDistance, OfARegionThatFillsItsBox) {
  cv::Mat1f distance(3, 3);
  distanceInside(cv::Mat1b(3, 3, uint8_t{255}), distance);
  EXPECT_FLOAT_EQ(distance(0, 0), 0.955F);
  EXPECT_FLOAT_EQ(distance(1, 1), 2 * 0.955F);
}

}  // namespace
}  // namespace redbee
