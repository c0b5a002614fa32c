// Places on the ground where there has been foreground, from boxes with known motion.
#include "redbee/detection/objects/place_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/detection/objects/ground_trail.hpp"

namespace redbee::test {
namespace {

constexpr double kStep_s = 0.1;
const Eigen::Vector2d kAtRest(0, 0);

Eigen::Matrix3d shift(double x, double y) {
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();
  ground.topRightCorner<2, 1>() << x, y;
  return ground;
}

Component componentAt(const cv::Rect& box) {
  Component component;
  component.box = box;
  return component;
}

void step(PlaceHistory& places, const Eigen::Matrix3d& ground, const std::vector<cv::Rect>& boxes) {
  places.propagate(kStep_s, ground);
  std::vector<Component> components;
  for (const cv::Rect& box : boxes) components.push_back(componentAt(box));
  places.note(components);
}

TEST(PlaceHistory, AddsUpHowLongAPlaceWasCoveredWhileTheCameraMoves) {
  PlaceHistory places;
  for (int k = 0; k < 8; ++k) step(places, shift(7, -3), {{100 + 7 * k, 100 - 3 * k, 20, 20}});
  places.propagate(kStep_s, shift(7, -3));
  const cv::Rect2d there(100 + 7 * 8, 100 - 3 * 8, 20, 20);
  const Eigen::Vector2d fast(1000, 0);  // px/s: wherever it came from, it was not here
  EXPECT_NEAR(places.occupiedBefore(there, fast), 0.8, 1e-9);
  EXPECT_EQ(places.occupiedBefore(there + cv::Point2d(30, 0), fast), 0);
}

TEST(PlaceHistory, WhatTheObjectItselfCoveredOnItsWayDoesNotCount) {
  constexpr int kSpeed_px = 4;  // per step
  PlaceHistory places;
  for (int k = 0; k < 20; ++k) step(places, shift(0, 0), {{100 + kSpeed_px * k, 100, 40, 40}});
  places.propagate(kStep_s, shift(0, 0));
  const cv::Rect2d now(100 + kSpeed_px * 20, 100, 40, 40);
  EXPECT_EQ(places.occupiedBefore(now, {kSpeed_px / kStep_s, 0}), 0);
  EXPECT_EQ(places.occupiedBefore(now, kAtRest), 0) << "one that rests has been here all the time";
}

TEST(PlaceHistory, CountsTheWaveThatWasHereBefore) {
  PlaceHistory places;
  for (int k = 0; k < 20; ++k) step(places, shift(0, 0), {{100 + (k % 10 < 5 ? 0 : 60), 100, 40, 40}});
  for (int k = 0; k < 4; ++k) step(places, shift(0, 0), {{100 + 30 - 10 * k, 100, 40, 40}});
  places.propagate(kStep_s, shift(0, 0));
  // It comes in with 100 px/s. Twice half a second at this place, and two of its own steps, of which one is
  // further away than half its width.
  EXPECT_NEAR(places.occupiedBefore({100, 100, 40, 40}, {-100, 0}), 1.0, 0.11);
}

TEST(PlaceHistory, ForgetsWhatIsOldAndWhatAnUnknownStepSeparates) {
  PlaceHistory places;
  const Eigen::Vector2d fast(1000, 0);
  const cv::Rect box(100, 100, 20, 20);
  step(places, shift(0, 0), {box});
  for (int k = 0; k < 48; ++k) places.propagate(kStep_s, shift(0, 0));
  EXPECT_GT(places.occupiedBefore(box, fast), 0);
  for (int k = 0; k < 3; ++k) places.propagate(kStep_s, shift(0, 0));
  EXPECT_EQ(places.occupiedBefore(box, fast), 0);

  step(places, shift(0, 0), {box});
  places.propagate(kStep_s, std::nullopt);
  EXPECT_EQ(places.occupiedBefore(box, fast), 0);
}

TEST(GroundTrail, MeasuresVelocityOverTheGroundWhileTheCameraMoves) {
  GroundTrail trail;
  const Eigen::Matrix3d ground = shift(5, 2);
  EXPECT_EQ(trail.velocity(), kAtRest);
  for (int k = 0; k < 30; ++k) {
    if (k > 0) trail.propagate(kStep_s, ground);
    trail.note({100 + 5 * k + 3 * k, 200 + 2 * k - 1 * k}, 20);
  }
  EXPECT_NEAR(trail.velocity().x(), 3 / kStep_s, 1e-9);
  EXPECT_NEAR(trail.velocity().y(), -1 / kStep_s, 1e-9);
  EXPECT_NEAR(trail.farthest(), 29 * std::hypot(3, 1) / 20, 1e-9);
}

TEST(GroundTrail, HasNoVelocityBeforeFourPositionsNorAcrossAnUnknownStep) {
  GroundTrail trail;
  for (int k = 0; k < 3; ++k) {
    trail.note({10.0 * k, 0}, 20);
    EXPECT_EQ(trail.velocity(), kAtRest);
    trail.propagate(kStep_s, shift(0, 0));
  }
  trail.note({30, 0}, 20);
  EXPECT_GT(trail.velocity().x(), 0);
  trail.propagate(kStep_s, std::nullopt);
  trail.note({40, 0}, 20);
  EXPECT_EQ(trail.velocity(), kAtRest);
}

}  // namespace
}  // namespace redbee::test
