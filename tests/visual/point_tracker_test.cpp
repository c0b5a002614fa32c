#include "redbee/visual/point_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "redbee/visual/patch_alignment.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

struct Accuracy {
  double median_px = 0;
  double fraction = 0;  ///< tracked within 1 px, of the grid points that stay in view
};

Accuracy accuracyOf(const PointTracks& tracks, const Eigen::Matrix3d& H) {
  int in_view = 0;
  const int grid = TrackerParameters().grid_px;
  for (int y = grid / 2; y < kHeight; y += grid) {
    for (int x = grid / 2; x < kWidth; x += grid) {
      const Eigen::Vector2d to = transfer(H, Eigen::Vector2d(x, y));
      in_view += to.x() > 8 && to.y() > 8 && to.x() < kWidth - 9 && to.y() < kHeight - 9 ? 1 : 0;
    }
  }
  std::vector<double> errors;
  for (std::size_t i = 0; i < tracks.previous.size(); ++i) {
    const Eigen::Vector2d expected = transfer(H, Eigen::Vector2d(tracks.previous[i].x, tracks.previous[i].y));
    errors.push_back((expected - Eigen::Vector2d(tracks.current[i].x, tracks.current[i].y)).norm());
  }
  std::sort(errors.begin(), errors.end());
  const auto within = std::count_if(errors.begin(), errors.end(), [](double e) { return e < 1.0; });
  return {errors.empty() ? INFINITY : errors[errors.size() / 2], static_cast<double>(within) / in_view};
}

Accuracy trackOnce(const Eigen::Matrix3d& H, const std::optional<Eigen::Matrix3d>& guess, double gain = 1,
                   double offset = 0) {
  const Canvas canvas(3);
  PointTracker tracker({});
  EXPECT_TRUE(tracker.advance(canvas.view(Eigen::Matrix3d::Identity(), 1.5, 1), {}).previous.empty());
  cv::Mat second;
  canvas.view(H, 1.5, 2).convertTo(second, CV_8U, gain, offset);
  return accuracyOf(tracker.advance(second, guess), H);
}

TEST(PointTracker, FollowsTwentyPixelsAndFifteenDegreesASecondFromAGuess) {
  const Eigen::Matrix3d H = groundHomography({15, 0, 15}, {10, 0, 2});
  const double motion = meanTransferError(H, Eigen::Matrix3d::Identity(), kWidth, kHeight);
  Eigen::Matrix3d guess = H;
  guess(0, 2) += 1.5;
  guess(1, 2) -= 1.0;
  const Accuracy a = trackOnce(H, guess);
  std::cout << "motion " << motion << " px; median error " << a.median_px << " px, fraction tracked "
            << a.fraction << "\n";
  EXPECT_GT(motion, 20);
  EXPECT_LT(a.median_px, 0.1);
  EXPECT_GT(a.fraction, 0.9);
}

TEST(PointTracker, FollowsTwentyPixelsWithoutAGuess) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = 17.3;
  H(1, 2) = -11.6;
  const Accuracy a = trackOnce(H, {});
  std::cout << "median error " << a.median_px << " px, fraction tracked " << a.fraction << "\n";
  EXPECT_LT(a.median_px, 0.1);
  EXPECT_GT(a.fraction, 0.9);
}

TEST(PointTracker, IsInvariantToExposure) {
  const Eigen::Matrix3d H = groundHomography({3, -4, 2}, {1, 0, 2});
  const Accuracy a = trackOnce(H, {}, 0.8, 30);
  std::cout << "median error " << a.median_px << " px, fraction tracked " << a.fraction << "\n";
  EXPECT_LT(a.median_px, 0.1);
  EXPECT_GT(a.fraction, 0.9);
}

TEST(PointTracker, SurvivesRaggedImages) {
  PointTracker tracker({});
  EXPECT_THROW(tracker.advance(cv::Mat(), {}), std::invalid_argument);
  for (const int side : {1, 2, 7, 20, 33}) {
    const cv::Mat tiny(side, side, CV_8U, cv::Scalar(90));
    EXPECT_TRUE(tracker.advance(tiny, {}).previous.empty());
    EXPECT_TRUE(tracker.advance(tiny, {}).previous.empty());
  }
  const cv::Mat view = Canvas(4).view(Eigen::Matrix3d::Identity(), 1, 1);
  EXPECT_TRUE(tracker.advance(view, {}).previous.empty()) << "a change of size restarts";
  const PointTracks standing = tracker.advance(view, {});
  EXPECT_GT(standing.previous.size(), 0.75 * standing.sampled);
  // A guess that is not a number finds nothing and does no harm.
  const Eigen::Matrix3d nonsense = Eigen::Matrix3d::Constant(NAN);
  EXPECT_TRUE(tracker.advance(view, nonsense).previous.empty());
}

TEST(PointTracker, FollowsLittleTextureMoreDensely) {
  const cv::Rect patch(200, 120, 240, 240);
  const cv::Mat textured = Canvas(4).view(Eigen::Matrix3d::Identity(), 1, 1);
  cv::Mat bare(textured.size(), CV_8U, cv::Scalar(90));
  textured(patch).copyTo(bare(patch));
  const int grid = TrackerParameters().grid_px;
  PointTracker tracker({});
  tracker.advance(textured, {});
  const PointTracks usual = tracker.advance(textured, {});
  tracker.reset();
  tracker.advance(bare, {});
  const PointTracks dense = tracker.advance(bare, {});
  const auto inside = std::count_if(usual.previous.begin(), usual.previous.end(),
                                    [&](const cv::Point2f& p) { return patch.contains(cv::Point(p)); });
  EXPECT_NEAR(static_cast<double>(inside), static_cast<double>(patch.area()) / (grid * grid), 30);
  // Half the grid is four times the points; the patch's edge can be followed, too, which makes them more.
  EXPECT_GT(dense.previous.size(), 3 * inside);
  EXPECT_NEAR(static_cast<double>(dense.sampled) / usual.sampled, 4, 0.4);
}

TEST(PointTracker, APartOfALargerImageEndsAtItsOwnEdge) {
  const cv::Mat large = Canvas(5).view(Eigen::Matrix3d::Identity(), 1, 1);
  const cv::Mat part = large(cv::Rect(100, 60, 320, 240));
  PointTracker of_part({}), of_copy({});
  of_part.advance(part, {});
  of_copy.advance(part.clone(), {});
  const PointTracks a = of_part.advance(part, {});
  const PointTracks b = of_copy.advance(part.clone(), {});
  EXPECT_EQ(a.previous, b.previous);
  EXPECT_EQ(a.current, b.current);
}

using PatchTemplateLanes = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(PatchTemplateLanes);

TEST_P(PatchTemplateLanes, PortableAndNativeAgreeToTheBit) {
  const Canvas canvas(6);
  for (const int window : {5, 13, 21, 31}) {
    const PatchShape shape(window);
    const Pyramid before(canvas.view(Eigen::Matrix3d::Identity(), 2, 1), 1, shape.margin(), 8);
    const Pyramid after(canvas.view(groundHomography({4, 4, 4}, {1, 0, 1}), 2, 2), 1, shape.margin(), 8);
    PatchTemplate<PortableLanes> portable(shape);
    PatchTemplate<NativeLanes> native(shape);
    for (int x = 3; x < kWidth; x += 37) {
      portable.extract(before[0], x, x % kHeight);
      native.extract(before[0], x, x % kHeight);
      Eigen::Vector2d a(x + 0.3, x % kHeight + 1.7), b = a;
      EXPECT_EQ(portable.residual(after[0], a), native.residual(after[0], b));
      EXPECT_EQ(portable.align(after[0], a, {8, 0.01}), native.align(after[0], b, {8, 0.01}));
      EXPECT_EQ(a, b);
      EXPECT_EQ(portable.smallestEigenvalue(), native.smallestEigenvalue());
    }
  }
}

TEST(PatchShape, RefusesWindowsItCannotHold) {
  EXPECT_THROW(PatchShape(12), std::invalid_argument);
  EXPECT_THROW(PatchShape(1), std::invalid_argument);
  EXPECT_THROW(PatchShape(33), std::invalid_argument);
}

}  // namespace
}  // namespace redbee::test
