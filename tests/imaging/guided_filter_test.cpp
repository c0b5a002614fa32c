#include "redbee/imaging/guided_filter.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace redbee
