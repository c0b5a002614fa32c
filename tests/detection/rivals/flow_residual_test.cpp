#include "redbee/detection/rivals/flow_residual.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

TEST(FlowResidual, IsZeroWhereTheHomographyExplainsTheFlow) {
  const cv::Matx33d H(1.01, 0.002, 3, -0.003, 0.99, -2, 1e-6, 2e-6, 1);
  const cv::Matx33d back = H.inv();
  cv::Mat flow(60, 80, CV_32FC2);
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec3d p = back * cv::Vec3d(x, y, 1);
      flow.at<cv::Vec2f>(y, x) = {static_cast<float>(p[0] / p[2] - x), static_cast<float>(p[1] / p[2] - y)};
    }
  }
  flow.at<cv::Vec2f>(30, 40) += cv::Vec2f(3, 4);
  const cv::Mat remains = flowAgainst(flow, H);
  EXPECT_NEAR(remains.at<float>(30, 40), 5, 1e-4);
  EXPECT_NEAR(remains.at<float>(20, 20), 0, 1e-4);
}

}  // namespace
}  // namespace redbee::test
