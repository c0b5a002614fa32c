// Which evidence makes a track, and the same at 10 and at 30 Hz.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/support/tracked_objects.hpp"

namespace redbee::test {
namespace {

constexpr double kWeak = 0.58, kStrong = 0.9;  // P_FG below and above the default threshold

ObjectParameters shipped() {
  ObjectParameters parameters;
  parameters.opening_px = parameters.closing_px = 0;
  return parameters;
}

cv::Rect walker(double time_s) { return {static_cast<int>(100 + 90 * time_s), 200, 20, 30}; }

/// s until a walker of this P_FG is reported; 2 if it is not.
double reportedAfter(double probability, double rate_hz, double gain = 1, double residual = 1) {
  TrackerFlight flight(shipped(), rate_hz);
  flight.setResidual(residual);
  for (double time_s = 0; time_s < 2; time_s += 1 / rate_hz) {
    if (!flight.step({{walker(time_s), probability, gain}}).empty()) return time_s;
  }
  return 2;
}

TEST(TrackBeforeDetect, WeakEvidenceThatPersistsIsConfirmedAndStrongSooner) {
  EXPECT_LT(reportedAfter(kWeak, 24), 1.5);
  EXPECT_LT(reportedAfter(kStrong, 24), 0.7 * reportedAfter(kWeak, 24));
  EXPECT_GT(reportedAfter(kStrong, 24), 0) << "one frame is no track";
}

TEST(TrackBeforeDetect, WhatStaticSurfacesExplainAsWellIsConfirmedLaterOrNever) {
  EXPECT_LT(reportedAfter(kWeak, 24, 4), 0.7 * reportedAfter(kWeak, 24));
  EXPECT_GT(reportedAfter(kStrong, 24, 0.3), 1.5 * reportedAfter(kStrong, 24));
  EXPECT_EQ(reportedAfter(kStrong, 24, 0), 2);
}

TEST(TrackBeforeDetect, WhereAllMovesUnlikeAStaticSurfaceMoreEvidenceIsNeeded) {
  EXPECT_EQ(reportedAfter(kStrong, 24, 1, 0.3), reportedAfter(kStrong, 24)) << "a static scene";
  EXPECT_GT(reportedAfter(kStrong, 24, 1, 7.4), 1.4 * reportedAfter(kStrong, 24)) << "surf: e^2, minus 1";
  EXPECT_EQ(reportedAfter(kStrong, 24, 1, 60), 2) << "minus 2.05, and its odds are 2.20 - 0.20";
  EXPECT_LT(reportedAfter(kStrong, 24, 4, 7.4), 2) << "unless its flow explains the image well";
}

/// A camera that looks straight down from 20 m; the parallax lies along x.
CameraStep lookingDown(double x_m) {
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  return {{Eigen::Matrix3d::Identity(), {-x_m, 0, 0}, Eigen::Vector3d::UnitZ(), 20}, K};
}

/// s until an object that moves by px_s over the ground is reported; 2 if
/// it is not.
double reportedAt(const Eigen::Vector2d& px_s, double probability) {
  TrackerFlight flight(shipped());
  const CameraStep step = lookingDown(0.05);
  flight.setCamera(step);
  const Eigen::Matrix3d ground = planeHomography(step.cameras, step.motion);
  for (int k = 0; k < 48; ++k) {
    const double time_s = k / 24.0;
    const cv::Point at(static_cast<int>(500 + ground(0, 2) * k + px_s.x() * time_s),
                       static_cast<int>(200 + px_s.y() * time_s));
    if (!flight.step({{cv::Rect(at, cv::Size(20, 30)), probability}}, ground).empty()) return time_s;
  }
  return 2;
}

TEST(TrackBeforeDetect, APathThatNoStaticSurfaceHasConfirmsWeakEvidence) {
  constexpr double kFaint = 0.53;  // P_FG: alone it never confirms a track
  EXPECT_LT(reportedAt({0, 40}, kFaint), 1.5) << "across the travel";
  EXPECT_EQ(reportedAt({0, 0}, kFaint), 2) << "on the ground";
  // A treetop at half the height of the camera goes by twice as fast.
  EXPECT_EQ(reportedAt({-30, 0}, kFaint), 2) << "a treetop";
  EXPECT_LT(reportedAt({30, 0}, kFaint), 1.5) << "with the drone, as nothing static does";
}

TEST(TrackBeforeDetect, StrongEvidenceThatDoesNotPersistIsNotConfirmed) {
  TrackerFlight flight(shipped());
  for (int k = 0; k < 72; ++k) {
    const cv::Rect elsewhere(50 + 97 * (k * k % 5), 60 + 83 * (k % 4), 20, 30);
    EXPECT_TRUE(flight.step({{elsewhere, kStrong}}).empty()) << "frame " << k;
    EXPECT_EQ(cv::countNonZero(flight.mask()), 0);
  }
}

TEST(TrackBeforeDetect, EvidenceThatFlickersInPlaceIsNotConfirmed) {
  TrackerFlight flight(shipped());
  for (int k = 0; k < 72; ++k) {
    const bool on = k % 6 == 0;
    EXPECT_TRUE(flight.step(on ? Regions{{{100, 200, 20, 30}, kStrong}} : Regions{}).empty())
        << "frame " << k;
  }
}

TEST(TrackBeforeDetect, WeakEvidenceThatSwaysAboutItsPlaceIsNotConfirmed) {
  TrackerFlight flight(shipped());
  for (int k = 0; k < 96; ++k) {
    const cv::Rect leaves(100 + static_cast<int>(8 * std::sin(0.5 * k)), 200, 20, 30);
    EXPECT_TRUE(flight.step({{leaves, kWeak}}).empty()) << "frame " << k;
  }
}

TEST(TrackBeforeDetect, TheTimeToConfirmIsThatOfTenAndOfThirtyHertz) {
  for (const double probability : {kWeak, kStrong}) {
    EXPECT_NEAR(reportedAfter(probability, 10), reportedAfter(probability, 30), 0.1001) << probability;
  }
}

TEST(TrackBeforeDetect, AnIdentityEndsAtTheSameTimeAtTenAndThirtyHertz) {
  const auto keptFor = [](double rate_hz) {
    TrackerFlight flight(shipped(), rate_hz);
    double time_s = 0;
    for (; time_s < 1; time_s += 1 / rate_hz) flight.step({{walker(time_s), kStrong}});
    double kept_s = 0;
    while (kept_s < 20 && !flight.step({}).empty()) kept_s += 1 / rate_hz;
    return kept_s;
  };
  EXPECT_NEAR(keptFor(10), keptFor(30), 0.1001);
  EXPECT_NEAR(keptFor(30), shipped().max_missed_s, 0.1001);
}

TEST(TrackBeforeDetect, TheMaskHoldsWhatIsReported) {
  TrackerFlight flight(shipped());
  for (int k = 0; k < 24; ++k) {
    const cv::Rect flash(400, 60 + 40 * (k % 8), 30, 30);
    const auto tracks = flight.step({{walker(k / 24.0), kStrong}, {flash, kStrong}});
    const cv::Rect masked = cv::boundingRect(flight.mask());
    ASSERT_LE(tracks.size(), 1U);
    EXPECT_EQ(masked, tracks.empty() ? cv::Rect() : walker(k / 24.0)) << "frame " << k;
  }
}

}  // namespace
}  // namespace redbee::test
