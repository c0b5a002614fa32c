#include "redbee/visual/visual_homography.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "redbee/imaging/repeated_image.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "redbee/visual/front_plane_estimator.hpp"
#include "tests/support/textured_images.hpp"

namespace redbee::test {
namespace {

/// The kth of 24 frames a second.
CameraTime frameTime(int k) { return CameraTime(k * Duration(41667)); }

cv::Mat still(unsigned noise_seed) { return Canvas(8).view(Eigen::Matrix3d::Identity(), 1.5, noise_seed); }

/// Covers a fraction of the image, in scattered blocks, with independently moving texture.
void scatter(cv::Mat& before, cv::Mat& after, double fraction, unsigned seed) {
  constexpr int kBlock = 40;
  cv::RNG rng(seed);
  const Canvas other(77);
  const cv::Mat strange = other.view(Eigen::Matrix3d::Identity(), 1, 3);
  for (int y = 0; y < kHeight; y += kBlock) {
    for (int x = 0; x < kWidth; x += kBlock) {
      if (rng.uniform(0.0, 1.0) >= fraction) continue;
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
    estimator.step(frameTime(1), before, {});
    const VisualHomography found = estimator.step(frameTime(2), after, {});
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
    const VisualHomography found = estimator.step(frame.time, frame.image.grey, {});
    if (k == 0) continue;
    ASSERT_EQ(found.status, VisualStatus::kGood) << "frame " << k;
    sum += meanTransferError(found.ground->H, flight.homography(k), kWidth, kHeight) / kFrames;
    front_planes += FrontPlaneEstimator(kWidth, kHeight, {}).estimate(found.tracks, found.ground->H) ? 1 : 0;
  }
  std::cout << "mean transfer error " << sum << " px; front planes " << front_planes << "\n";
  EXPECT_LT(sum, 0.1);
  EXPECT_EQ(front_planes, 0);
}

TEST(VisualHomography, APredictionThatLeadsNowhereIsIgnored) {
  const simulation::FlightSimulator flight(simulation::groundOnly(2));
  VisualHomographyEstimator estimator({});
  HomographyPrediction wrong{Eigen::Matrix3d::Identity(), 1e-6 * Matrix8d::Identity()};
  wrong.H(0, 2) = 300;  // px, far beyond what the search reaches
  int lost = 0, found = 0;
  for (int k = 0; k < 20; ++k) {
    const auto frame = flight.frame(k);
    const VisualHomography result = estimator.step(frame.time, frame.image.grey, wrong);
    if (k == 0) continue;
    if (result.status != VisualStatus::kGood) {
      ++lost;
      continue;
    }
    ++found;
    EXPECT_LT(meanTransferError(result.ground->H, flight.homography(k), 640, 480), 0.2) << "frame " << k;
  }
  EXPECT_EQ(lost, 5);
  EXPECT_EQ(found, 14);
}

/// A repeated image is one only for a prediction that is used.
TEST(VisualHomography, ThePredictionIsUsedAgainOnceTheClockWasSetBack) {
  const Canvas canvas(8);
  const Eigen::Matrix3d step = groundHomography({3, 2, 3}, {0.4, 0.2, 1});
  const HomographyPrediction moving{step, 1e-6 * Matrix8d::Identity()};
  HomographyPrediction wrong = moving;
  wrong.H(0, 2) = 300;  // px, far beyond what the search reaches
  const cv::Mat image = canvas.view(Eigen::Matrix3d::Identity(), 1.5, 1);
  for (const int first : {1, 1000}) {  // the clock goes on, or is set back
    VisualHomographyEstimator estimator({});
    Eigen::Matrix3d since = Eigen::Matrix3d::Identity();
    for (int k = 0; k <= 5; ++k) {
      estimator.step(frameTime(first + k), canvas.view(since, 1.5, static_cast<uint64_t>(k)), wrong);
      since = normaliseHomography(step * since);
    }
    estimator.step(frameTime(10), image, moving);
    const VisualHomography repeated = estimator.step(frameTime(11), image, moving);
    if (first > 10) {
      EXPECT_EQ(repeated.status, VisualStatus::kRepeated);
    } else {
      EXPECT_NE(repeated.status, VisualStatus::kRepeated) << "the trial has no difficulty";
    }
  }
}

TEST(VisualHomography, BlankBlackAndBlurredFramesAreNoHomography) {
  cv::Mat blurred;
  cv::GaussianBlur(still(3), blurred, {}, 9);
  const cv::Mat black(kHeight, kWidth, CV_8U, cv::Scalar(0));
  const cv::Mat blank(kHeight, kWidth, CV_8U, cv::Scalar(200));
  for (const cv::Mat& bad : {black, blank, blurred}) {
    VisualHomographyEstimator estimator({});
    estimator.step(frameTime(1), still(1), {});
    const VisualHomography blind = estimator.step(frameTime(2), bad, {});
    EXPECT_EQ(blind.status, VisualStatus::kNoTexture);
    EXPECT_FALSE(blind.ground);
    // The next good frame is tracked from the last good one.
    const VisualHomography next = estimator.step(frameTime(3), still(4), {});
    EXPECT_EQ(next.status, VisualStatus::kGood);
    EXPECT_EQ(next.time_previous, frameTime(1));
  }
}

TEST(VisualHomography, AnImageThatIsRepeatedIsNoMeasurementOfAFlightThatGoesOn) {
  const Canvas canvas(8);
  const Eigen::Matrix3d step = groundHomography({3, 2, 3}, {0.4, 0.2, 1});
  const HomographyPrediction one{step, 1e-6 * Matrix8d::Identity()};
  const HomographyPrediction two{normaliseHomography(step * step), 1e-6 * Matrix8d::Identity()};
  const cv::Mat first = canvas.view(Eigen::Matrix3d::Identity(), 1.5, 1);
  VisualHomographyEstimator estimator({});
  estimator.step(frameTime(1), first, {});
  const VisualHomography repeated = estimator.step(frameTime(2), first, one);
  EXPECT_EQ(repeated.status, VisualStatus::kRepeated);
  EXPECT_FALSE(repeated.ground);
  const VisualHomography next = estimator.step(frameTime(3), canvas.view(two.H, 1.5, 2), two);
  ASSERT_EQ(next.status, VisualStatus::kGood);
  EXPECT_EQ(next.time_previous, frameTime(1));
  EXPECT_LT(meanTransferError(next.ground->H, two.H, kWidth, kHeight), 0.1);
}

TEST(VisualHomography, AStillSceneIsNoRepetition) {
  const HomographyPrediction still_camera{Eigen::Matrix3d::Identity(), 1e-6 * Matrix8d::Identity()};
  const HomographyPrediction moving{groundHomography({3, 2, 3}, {0.4, 0.2, 1}), 1e-6 * Matrix8d::Identity()};
  VisualHomographyEstimator estimator({});
  estimator.step(frameTime(1), still(1), {});
  EXPECT_EQ(estimator.step(frameTime(2), still(1), {}).status, VisualStatus::kGood)
      << "nothing else is known";
  EXPECT_EQ(estimator.step(frameTime(3), still(1), still_camera).status, VisualStatus::kGood);
  const VisualHomography other = estimator.step(frameTime(4), still(2), moving);
  EXPECT_NE(other.status, VisualStatus::kRepeated) << "the sensor's noise is another";
}

TEST(VisualHomography, WhatIsRepeatedForLongIsTheScene) {
  const HomographyPrediction moving{groundHomography({3, 2, 3}, {0.4, 0.2, 1}), 1e-6 * Matrix8d::Identity()};
  VisualHomographyEstimator estimator({});
  estimator.step(frameTime(1), still(1), {});
  int k = 2;
  for (; frameTime(k) - frameTime(1) <= kMaxRepetition; ++k) {
    EXPECT_EQ(estimator.step(frameTime(k), still(1), moving).status, VisualStatus::kRepeated);
  }
  EXPECT_NE(estimator.step(frameTime(k), still(1), moving).status, VisualStatus::kRepeated);
}

TEST(VisualHomography, AModeratelyBlurredFrameStillServes) {
  cv::Mat streaked;
  cv::blur(still(3), streaked, {4, 1}, {1, 0});
  VisualHomographyEstimator estimator({});
  estimator.step(frameTime(1), still(1), {});
  EXPECT_EQ(estimator.step(frameTime(2), streaked, {}).status, VisualStatus::kGood);
}

TEST(VisualHomography, RestartsAfterTimesThatDoNotIncreaseGapsAndOtherSizes) {
  VisualHomographyEstimator estimator({});
  EXPECT_EQ(estimator.step(frameTime(10), still(1), {}).status, VisualStatus::kFirstFrame);
  EXPECT_EQ(estimator.step(frameTime(10), still(2), {}).status, VisualStatus::kFirstFrame) << "repeated";
  EXPECT_EQ(estimator.step(frameTime(9), still(3), {}).status, VisualStatus::kFirstFrame) << "earlier";
  EXPECT_EQ(estimator.step(frameTime(10), still(4), {}).status, VisualStatus::kGood);
  EXPECT_EQ(estimator.step(frameTime(60), still(5), {}).status, VisualStatus::kFirstFrame) << "gap";
  const cv::Mat smaller = still(6)(cv::Rect(0, 0, 320, 240));
  EXPECT_EQ(estimator.step(frameTime(61), smaller, {}).status, VisualStatus::kFirstFrame) << "size";
  EXPECT_EQ(estimator.step(frameTime(62), smaller, {}).status, VisualStatus::kGood);
}

TEST(VisualHomography, TheSameFramesGiveTheSameHomography) {
  const auto run = [] {
    VisualHomographyEstimator estimator({});
    estimator.step(frameTime(1), still(1), {});
    return estimator.step(frameTime(2), Canvas(8).view(groundHomography({5, 5, 5}, {1, 0, 1}), 1.5, 2), {});
  };
  const VisualHomography a = run(), b = run();
  ASSERT_TRUE(a.ground && b.ground);
  EXPECT_EQ(a.ground->H, b.ground->H);
  EXPECT_EQ(a.tracks.current, b.tracks.current);
}

}  // namespace
}  // namespace redbee::test
