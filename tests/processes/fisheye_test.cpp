// A simulated flight with a fisheye lens: images are rectified to the lens' ideal camera, maps come back on
// the raw image's grid.
#include <gtest/gtest.h>

#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 96;   ///< walkers have left their places by then, and count as objects
constexpr int kSettled = 16;  ///< the background is known by then

simulation::Scenario withFisheye(simulation::Scenario scenario) {
  scenario.intrinsics = {640, 480, 305, 303, 319.5, 239.5, {-0.018, 0.0075, -0.0042, 0.0006}, "equidistant"};
  return scenario;
}

cv::Mat1b decoded(const std::vector<uint8_t>& png) { return cv::imdecode(png, cv::IMREAD_GRAYSCALE); }

struct Overlap {
  int truth = 0, marked = 0, both = 0;
};

TEST(Fisheye, TheGroundIsTrackedAndTheMoversAreFound) {
  const StackFlight flight = stackFlight(withFisheye(simulation::walkers(2)), kFrames);
  const StackOutput output = StackRun(flight).run();
  double worst_px = 0;
  Overlap overlap;
  for (int k = kSettled; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    const fused_homography_t& fused = output.fused.at(utime);
    ASSERT_EQ(fused.source, fused_homography_t::FUSED);
    worst_px = std::max(worst_px, groundError(fused, flight.homographies[static_cast<size_t>(k)]));
    const cv::Mat1b mask = decoded(output.foreground.at(utime).mask);
    ASSERT_EQ(mask.size(), cv::Size(640, 480));
    const cv::Mat1b truth = flight.masks[static_cast<size_t>(k)] == 255;
    overlap.truth += cv::countNonZero(truth);
    overlap.marked += cv::countNonZero(mask);
    overlap.both += cv::countNonZero(truth & mask);
  }
  std::cout << "worst ground error " << worst_px << " px; of the movers' area " << overlap.both << " of "
            << overlap.truth << " px marked, " << overlap.marked - overlap.both << " px beside them\n";
  EXPECT_LT(worst_px, 1);
  EXPECT_GT(overlap.both, overlap.truth / 5);
  EXPECT_LT(overlap.marked - overlap.both, overlap.both);
}

/// 60 degrees to the side, beyond what the rectified image covers: nothing is known there, and nothing is
/// reported as moving.
TEST(Fisheye, WhatTheRectifiedImageDoesNotCoverIsUnknown) {
  const StackFlight flight = stackFlight(withFisheye(simulation::walkers(2)), kSettled);
  const StackOutput output = StackRun(flight).run();
  const foreground_t& last = output.foreground.rbegin()->second;
  ASSERT_EQ(last.status, foreground_t::GOOD);
  const cv::Mat1b unknown = decoded(last.unknown);
  EXPECT_EQ(unknown(240, 1), 255);
  EXPECT_EQ(unknown(240, 638), 255);
  EXPECT_EQ(unknown(240, 320), 0);
  EXPECT_EQ(decoded(last.mask)(240, 1), 0);
}

}  // namespace
}  // namespace redbee::test
