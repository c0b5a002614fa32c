#include "redbee/results/overlay.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

TEST(Overlay, ShowsMaskAndBoxesAndLeavesTheRest) {
  const cv::Mat image(120, 200, CV_8UC1, cv::Scalar(100));
  cv::Mat1b mask = cv::Mat1b::zeros(image.size());
  cv::rectangle(mask, {60, 60, 20, 20}, cv::Scalar(255), cv::FILLED);
  Detection detection;
  detection.id = 3;
  detection.box = {55, 55, 30, 30};
  const cv::Mat overlay = drawOverlay(image, mask, {detection},
                                      {CameraTime(std::chrono::milliseconds(1500)), 24, "fused", 2, ""});
  ASSERT_EQ(overlay.type(), CV_8UC3);
  EXPECT_EQ(overlay.at<cv::Vec3b>(100, 150), cv::Vec3b(100, 100, 100));
  const auto& inside = overlay.at<cv::Vec3b>(70, 70);
  EXPECT_GT(inside[2], inside[0] + 20) << "the mask is tinted red";
  EXPECT_NE(overlay.at<cv::Vec3b>(55, 70), cv::Vec3b(100, 100, 100)) << "the box";
  EXPECT_GT(cv::norm(overlay.rowRange(0, 25), cv::Mat(25, 200, CV_8UC3, cv::Scalar::all(100)), cv::NORM_INF),
            50)
      << "the status";
}

}  // namespace
}  // namespace redbee
