#include "redbee/detection/refinement/foreground_probability.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

TEST(ForegroundProbability, FollowsTheEquations) {
  const RefinementParameters p;
  ForegroundProbability probability(p);
  const cv::Mat foreground = cv::Mat::ones(20, 20, CV_32F);
  const cv::Mat order(20, 20, CV_32F, cv::Scalar(0.5));
  double temporal = 0, spatial = 0, entropy = 0;
  for (int k = 0; k < 3; ++k) {
    temporal = (1 - p.alpha) * temporal + p.alpha;
    spatial = (1 - p.beta) * spatial + p.beta;
    entropy = (1 - p.gamma) * entropy + p.gamma * 0.5;
    EXPECT_NEAR(probability.update(foreground, order).at<float>(10, 10), temporal * spatial * entropy, 1e-5);
  }
}

TEST(ForegroundProbability, MapsTravelWithTheGround) {
  ForegroundProbability probability({});
  cv::Mat foreground = cv::Mat::zeros(40, 40, CV_32F);
  foreground(cv::Rect(10, 10, 10, 10)).setTo(1);
  probability.update(foreground, {});
  Eigen::Matrix3d pan = kStill;
  pan(0, 2) = 7;
  probability.propagate(pan);
  cv::Mat moved = cv::Mat::zeros(40, 40, CV_32F);
  const cv::Mat after = probability.update(moved, {});
  EXPECT_GT(after.at<float>(15, 22), 0);
  EXPECT_EQ(after.at<float>(15, 11), 0);
}

}  // namespace
}  // namespace redbee
