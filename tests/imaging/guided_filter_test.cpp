#include "redbee/imaging/guided_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee {
namespace {

TEST(GuidedFilter, KeepsToTheEdgesOfTheImage) {
  cv::Mat image(40, 40, CV_8U, cv::Scalar(60));
  image.colRange(20, 40).setTo(180);
  cv::Mat map = cv::Mat::zeros(40, 40, CV_32F);
  map.colRange(22, 40).setTo(1);
  const cv::Mat filtered = guidedFilter(image, map, 4, 10);
  EXPECT_LT(filtered.at<float>(20, 18), 0.1);
  EXPECT_GT(filtered.at<float>(20, 21), 0.5) << "filled up to the edge";
}

/// The scalar reference, by OpenCV's functions.
cv::Mat1f referenceFilter(const cv::Mat& guide, const cv::Mat1f& map, int radius_px, double contrast) {
  const int shrink = std::clamp(radius_px / 2, 1, 4);
  const cv::Size small((guide.cols + shrink - 1) / shrink, (guide.rows + shrink - 1) / shrink);
  const int side = 2 * std::max(1, radius_px / shrink) + 1;
  const auto mean = [&](const cv::Mat1f& of) {
    cv::Mat1f blurred;
    cv::blur(of, blurred, {side, side});
    return blurred;
  };
  cv::Mat1f full_grey, grey, shrunk;
  guide.convertTo(full_grey, CV_32F);
  cv::resize(full_grey, grey, small, 0, 0, cv::INTER_AREA);
  cv::resize(map, shrunk, small, 0, 0, cv::INTER_AREA);
  const cv::Mat1f mean_grey = mean(grey), mean_map = mean(shrunk);
  const cv::Mat1f variance = mean(grey.mul(grey)) - mean_grey.mul(mean_grey);
  const cv::Mat1f covariance = mean(grey.mul(shrunk)) - mean_grey.mul(mean_map);
  cv::Mat1f slope = covariance / (variance + contrast * contrast);
  cv::Mat1f offset = mean_map - slope.mul(mean_grey);
  cv::resize(mean(slope), slope, guide.size(), 0, 0, cv::INTER_LINEAR);
  cv::resize(mean(offset), offset, guide.size(), 0, 0, cv::INTER_LINEAR);
  return slope.mul(full_grey) + offset;
}

class GuidedFilterWith : public test::WithInstructions {};
REDBEE_WITH_INSTRUCTIONS(GuidedFilterWith);

TEST_P(GuidedFilterWith, IsTheScalarOne) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(107, 61)}) {
    cv::Mat1b guide(size);
    cv::Mat1f map(size);
    cv::RNG(1).fill(guide, cv::RNG::UNIFORM, 0, 256);
    cv::RNG(2).fill(map, cv::RNG::UNIFORM, 0, 1);
    cv::GaussianBlur(guide, guide, {0, 0}, 2);
    for (const int radius_px : {1, 3, 4, 8}) {
      const cv::Mat1f found = guidedFilter(guide, map, radius_px, 12);
      const cv::Mat1f reference = referenceFilter(guide, map, radius_px, 12);
      // Double precision sums in another order round to the same floats, but for very few.
      EXPECT_LT(cv::norm(found, reference, cv::NORM_INF), 1e-5) << size << ", " << radius_px;
    }
  }
}

TEST(GuidedFilter, TakesAnImageSmallerThanItsWindow) {
  EXPECT_NO_THROW(guidedFilter(cv::Mat1b(3, 5, uint8_t{7}), cv::Mat1f(3, 5, 0.5F), 8, 12));
  EXPECT_NO_THROW(guidedFilter(cv::Mat1b(1, 1, uint8_t{7}), cv::Mat1f(1, 1, 0.5F), 3, 12));
}

}  // namespace
}  // namespace redbee
