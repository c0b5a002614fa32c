#include "redbee/detection/two_planes/background_model.hpp"

#include <gtest/gtest.h>

#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

class CanvasMargin : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(WarpedAndOnACanvas, CanvasMargin, testing::Values(0.0, 0.125));

TEST_P(CanvasMargin, FollowsAPanAndMarksUnknownPixels) {
  const cv::Mat world = noiseImage({400, 60}, 1, 120, 20);
  constexpr int kLearningFrames = 5;
  TwoPlaneParameters parameters;
  parameters.canvas_margin = GetParam();
  constexpr int kStep = 3;
  const cv::Size view(100, 60);
  BackgroundModel model(view, parameters, kLearningFrames);
  Eigen::Matrix3d pan = Eigen::Matrix3d::Identity();
  pan(0, 2) = -kStep;
  ForegroundMaps maps;
  for (int k = 0; k < 40; ++k) {
    if (k > 0) model.propagate(pan);
    cv::Mat image = world(cv::Rect(kStep * k, 0, view.width, view.height)).clone();
    if (k == 39) image(cv::Rect(40, 20, 10, 10)).setTo(255);
    maps = model.learn(image);
  }
  const int fresh = kStep * kLearningFrames;
  EXPECT_EQ(cv::countNonZero(maps.unknown), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(maps.unknown.colRange(view.width - fresh, view.width)), fresh * view.height);
  EXPECT_EQ(cv::countNonZero(maps.foreground), 100);
  EXPECT_EQ(cv::countNonZero(maps.foreground(cv::Rect(40, 20, 10, 10))), 100);
}

}  // namespace
}  // namespace redbee::test
