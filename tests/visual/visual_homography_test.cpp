#include "redbee/visual/visual_homography.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "redbee/simulation/scenarios.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kFrame = 41667;  // us

cv::Mat still(unsigned noise_seed) { return Canvas(8).view(Eigen::Matrix3d::Identity(), 1.5, noise_seed); }

/// Covers a share of the image, in scattered blocks, with a texture that moves by its own ways.
void scatter(cv::Mat& before, cv::Mat& after, double share, unsigned seed) {
  constexpr int kBlock = 40;
  cv::RNG rng(seed);
  const Canvas other(77);
  const cv::Mat strange = other.view(Eigen::Matrix3d::Identity(), 1, 3);
  for (int y = 0; y < kHeight; y += kBlock) {
    for (int x = 0; x < kWidth; x += kBlock) {
      if (rng.uniform(0.0, 1.0) >= share) continue;
      Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
      H(0, 2) = rng.uniform(-12.0, 12.0);
      H(1, 2) = rng.uniform(-12.0, 12.0);
      const cv::Rect block(x, y, kBlock, kBlock);
      strange(block).copyTo(before(block));
      other.view(H, 1, 4)(block).copyTo(after(block));
    }
  }
}

TEST(VisualHomography, ImagesWith40PercentThatMoveOtherwise) {
  double worst = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Canvas canvas(seed);
    const Eigen::Matrix3d H = groundHomography({6, -5, 8}, {0.8, 0.2, 2});
    cv::Mat before = canvas.view(Eigen::Matrix3d::Identity(), 1.5, 1);
    cv::Mat after = canvas.view(H, 1.5, 2);
    scatter(before, after, 0.4, seed);
    VisualHomographyEstimator estimator({});
    estimator.step(kFrame, before, {});
    const VisualHomography found = estimator.step(2 * kFrame, after, {});
    ASSERT_EQ(found.status, VisualStatus::kGood);
    const double error = meanTransferError(found.ground->H, H, kWidth, kHeight);
    std::cout << "mean transfer error " << error << " px, " << found.ground->inliers << " inliers, "
              << found.ground->outliers << " outliers\n";
    worst = std::max(worst, error);
  }
  RecordProperty("worst_mean_transfer_error_px", std::to_string(worst));
  EXPECT_LT(worst, 0.1);
}

TEST(VisualHomography, SimulatedFlight) {
  const simulation::FlightSimulator flight(simulation::groundOnly(2));
  VisualHomographyEstimator estimator({});
  double sum = 0;
  int front_planes = 0;
  constexpr int kFrames = 8;
  for (int k = 0; k <= kFrames; ++k) {
    const auto frame = flight.frame(k);
    const VisualHomography found = estimator.step(frame.utime, frame.image.grey, {});
    if (k == 0) continue;
    ASSERT_EQ(found.status, VisualStatus::kGood) << "frame " << k;
    sum += meanTransferError(found.ground->H, flight.homography(k), kWidth, kHeight) / kFrames;
    front_planes += estimateFrontPlane(found.tracks, found.ground->H, kWidth, kHeight, {}) ? 1 : 0;
  }
  std::cout << "mean transfer error " << sum << " px; front planes " << front_planes << "\n";
  EXPECT_LT(sum, 0.1);
  EXPECT_EQ(front_planes, 0);
}

TEST(VisualHomography, BlankBlackAndBlurredFramesAreNoHomography) {
  cv::Mat blurred;
  cv::GaussianBlur(still(3), blurred, {}, 9);
  const cv::Mat black(kHeight, kWidth, CV_8U, cv::Scalar(0));
  const cv::Mat blank(kHeight, kWidth, CV_8U, cv::Scalar(200));
  for (const cv::Mat& bad : {black, blank, blurred}) {
    VisualHomographyEstimator estimator({});
    estimator.step(kFrame, still(1), {});
    const VisualHomography blind = estimator.step(2 * kFrame, bad, {});
    EXPECT_EQ(blind.status, VisualStatus::kNoTexture);
    EXPECT_FALSE(blind.ground);
    // The next good frame is tracked from the last good one.
    const VisualHomography next = estimator.step(3 * kFrame, still(4), {});
    EXPECT_EQ(next.status, VisualStatus::kGood);
    EXPECT_EQ(next.utime_previous, kFrame);
  }
}

TEST(VisualHomography, AModeratelyBlurredFrameStillServes) {
  cv::Mat streaked;
  cv::blur(still(3), streaked, {4, 1}, {1, 0});
  VisualHomographyEstimator estimator({});
  estimator.step(kFrame, still(1), {});
  EXPECT_EQ(estimator.step(2 * kFrame, streaked, {}).status, VisualStatus::kGood);
}

TEST(VisualHomography, RestartsAfterTimesThatDoNotIncreaseGapsAndOtherSizes) {
  VisualHomographyEstimator estimator({});
  EXPECT_EQ(estimator.step(10 * kFrame, still(1), {}).status, VisualStatus::kFirstFrame);
  EXPECT_EQ(estimator.step(10 * kFrame, still(2), {}).status, VisualStatus::kFirstFrame) << "repeated";
  EXPECT_EQ(estimator.step(9 * kFrame, still(3), {}).status, VisualStatus::kFirstFrame) << "earlier";
  EXPECT_EQ(estimator.step(10 * kFrame, still(4), {}).status, VisualStatus::kGood);
  EXPECT_EQ(estimator.step(60 * kFrame, still(5), {}).status, VisualStatus::kFirstFrame) << "gap";
  const cv::Mat smaller = still(6)(cv::Rect(0, 0, 320, 240));
  EXPECT_EQ(estimator.step(61 * kFrame, smaller, {}).status, VisualStatus::kFirstFrame) << "size";
  EXPECT_EQ(estimator.step(62 * kFrame, smaller, {}).status, VisualStatus::kGood);
}

TEST(VisualHomography, TheSameFramesGiveTheSameHomography) {
  const auto run = [] {
    VisualHomographyEstimator estimator({});
    estimator.step(kFrame, still(1), {});
    return estimator.step(2 * kFrame, Canvas(8).view(groundHomography({5, 5, 5}, {1, 0, 1}), 1.5, 2), {});
  };
  const VisualHomography a = run(), b = run();
  ASSERT_TRUE(a.ground && b.ground);
  EXPECT_EQ(a.ground->H, b.ground->H);
  EXPECT_EQ(a.tracks.current, b.tracks.current);
}

}  // namespace
}  // namespace redbee::test
