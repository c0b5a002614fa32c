#include "redbee/detection/rivals/trajectory_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <set>

#include "tests/support/sliding_patch.hpp"

namespace redbee::test {
namespace {

TEST(TrajectoryWindow, TracksFollowTheGround) {
  TrajectoryWindowParameters parameters;
  parameters.frames = 5;
  parameters.least_frames = 5;
  TrajectoryWindow window(parameters);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(window.advance(slidingPatch()[k].input.grey));
    EXPECT_EQ(window.trajectories().cols(), 0) << "the window fills";
  }
  window.advance(slidingPatch()[4].input.grey);
  const Eigen::MatrixXd X = window.trajectories();
  ASSERT_EQ(X.rows(), 10);
  ASSERT_GT(X.cols(), 150);
  int right = 0;
  int on_ground = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    Eigen::Vector2d at = X.col(i).head<2>();
    const cv::Mat& truth = slidingPatch()[0].truth;
    if (truth.at<uint8_t>(static_cast<int>(at.y()), static_cast<int>(at.x())) != 0) continue;
    ++on_ground;
    for (size_t k = 1; k < 5; ++k) at = transfer(trueStep(k), at);
    right += (at - X.col(i).tail<2>()).norm() < 0.5 ? 1 : 0;
  }
  EXPECT_GT(right, 0.95 * on_ground);
}

TEST(TrajectoryWindow, ACellHoldsOneTrack) {
  TrajectoryWindow window({});
  for (const PatchFrame& frame : slidingPatch()) window.advance(frame.input.grey);
  const Eigen::MatrixXd X = window.trajectories();
  std::set<std::pair<int, int>> cells;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Eigen::Vector2d last = X.col(i).tail<2>();
    cells.emplace(static_cast<int>(last.x()) / window.parameters().grid_px,
                  static_cast<int>(last.y()) / window.parameters().grid_px);
  }
  EXPECT_EQ(static_cast<Eigen::Index>(cells.size()), X.cols());
}

TEST(TrajectoryWindow, IsAsLongAsItCanBeWhileItFills) {
  cv::Mat image(120, 160, CV_8U);
  cv::RNG random(1);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, {5, 5}, 0);
  TrajectoryWindowParameters parameters;
  parameters.frames = 5;
  parameters.least_frames = 3;
  TrajectoryWindow window(parameters);
  for (int round = 0; round < 2; ++round) {
    for (int k = 1; k <= 7; ++k) {
      EXPECT_TRUE(window.advance(image));
      const Eigen::MatrixXd X = window.trajectories();
      EXPECT_EQ(X.cols() > 0, k >= 3) << k;
      EXPECT_EQ(X.rows(), 2 * std::min(k, 5)) << k;
    }
    window.reset();
  }
}

}  // namespace
}  // namespace redbee::test
