#include "redbee/detection/two_planes/background_model.hpp"

#include <gtest/gtest.h>

#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

class CanvasMargin : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(CarriedAndAnchored, CanvasMargin, testing::Values(0.0, 0.125));

TEST_P(CanvasMargin, FollowsAPanAndKnowsWhatItHasNotSeen) {
  const cv::Mat world = noiseImage({400, 60}, 1, 120, 20);
  SegmentationParameters parameters;
  parameters.canvas_margin = GetParam();
  constexpr int kStep = 3;
  const cv::Size view(100, 60);
  BackgroundModel model(view, parameters);
  Eigen::Matrix3d pan = Eigen::Matrix3d::Identity();
  pan(0, 2) = -kStep;
  BackgroundVerdict verdict;
  for (int k = 0; k < 40; ++k) {
    if (k > 0) model.carry(pan);
    cv::Mat image = world(cv::Rect(kStep * k, 0, view.width, view.height)).clone();
    if (k == 39) image(cv::Rect(40, 20, 10, 10)).setTo(255);
    verdict = model.learn(image);
  }
  const int fresh = kStep * parameters.learning_frames;
  EXPECT_EQ(cv::countNonZero(verdict.unknown), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(verdict.unknown.colRange(view.width - fresh, view.width)), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(verdict.foreground), 100);
  EXPECT_EQ(cv::countNonZero(verdict.foreground(cv::Rect(40, 20, 10, 10))), 100);
}

}  // namespace
}  // namespace redbee::test
