#include "redbee/detection/two_planes/gaussian_mixture.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

TEST(GaussianMixture, LearnsTwoValuesAndSeesAThird) {
  GaussianMixture mixture({1, 1}, 50, 16);
  const cv::Mat valid(1, 1, CV_8U, cv::Scalar(255));
  const auto see = [&](int value) {
    return mixture.update(cv::Mat(1, 1, CV_8U, cv::Scalar(value)), valid).at<uint8_t>(0);
  };
  for (int k = 0; k < 60; ++k) see(k % 2 == 0 ? 60 : 160);
  EXPECT_EQ(see(60), 0);
  EXPECT_EQ(see(160), 0);
  EXPECT_EQ(see(110), 255);
}

TEST(GaussianMixture, ForgetsWhatIsNoLongerThere) {
  GaussianMixture mixture({1, 1}, 20, 16);
  const cv::Mat valid(1, 1, CV_8U, cv::Scalar(255));
  const auto see = [&](int value) {
    return mixture.update(cv::Mat(1, 1, CV_8U, cv::Scalar(value)), valid).at<uint8_t>(0);
  };
  for (int k = 0; k < 40; ++k) see(60);
  EXPECT_EQ(see(160), 255);
  for (int k = 0; k < 200; ++k) see(160);
  EXPECT_EQ(see(160), 0);
  EXPECT_EQ(see(60), 255);
}

}  // namespace
}  // namespace redbee::test
