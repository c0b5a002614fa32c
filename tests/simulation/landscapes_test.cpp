// Landscapes of many patches: what is one object, what is background, and that the seed decides everything.
#include "redbee/simulation/landscapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "redbee/simulation/scenarios.hpp"

namespace redbee::simulation {
namespace {

using Maker = Scenario (*)(unsigned seed);
constexpr std::array<Maker, 3> kLandscapes{park, street, shore};

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

/// A flight over plain ground without noise, and where the middle of its first image meets that ground.
Scenario plainFlight() {
  Scenario scenario = groundOnly(3);
  scenario.sensor.noise_sigma = 0;
  scenario.sensor.blur_sigma_px = 0;
  return scenario;
}

Eigen::Vector2d inTheMiddle(const Scenario& scenario) {
  const CameraPose pose = FlightSimulator(scenario).pose(0);
  const Eigen::Vector3d ahead = pose.R_CG.transpose() * Eigen::Vector3d::UnitZ();
  return (pose.p_GC - pose.p_GC.z() / ahead.z() * ahead).head<2>();
}

Patch upright(PatchKind kind, const Eigen::Vector2d& at) {
  return uprightPatch(kind, at.x(), at.y(), 0, 1, 1, Material());
}

/// Moments (m10 / m00) of a patch's pixels in the image.
double columnOf(const FlightSimulator& flight, int k, size_t patch) {
  const cv::Mat1b pixels = flight.frame(k).image.surface == 1 + static_cast<int>(patch);
  const cv::Moments moments = cv::moments(pixels, true);
  return moments.m10 / moments.m00;
}

std::vector<Eigen::Vector3d> placesIn(const Scenario& scenario) {
  std::vector<Eigen::Vector3d> places;
  for (const Patch& patch : scenario.scene.patches) places.push_back(patch.centre);
  return places;
}

TEST(Landscapes, TheSeedDecidesEverything) {
  for (const Maker make : kLandscapes) {
    EXPECT_EQ(placesIn(make(5)), placesIn(make(5)));
    EXPECT_NE(placesIn(make(5)), placesIn(make(6)));
  }
  const RenderedImage image = FlightSimulator(park(5)).frame(7).image,
                      again = FlightSimulator(park(5)).frame(7).image;
  EXPECT_TRUE(same(image.bgr, again.bgr));
  EXPECT_TRUE(same(image.id, again.id));
}

TEST(Landscapes, WhatMovesIsOneObjectOfSeveralPatchesAndOfOneMotion) {
  size_t movers = 0;
  for (const Maker make : kLandscapes) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const Scenario scenario = make(seed);
      std::map<int, std::vector<const Patch*>> objects;
      for (const Patch& patch : scenario.scene.patches) {
        if (patch.kind == PatchKind::kMover) objects[patch.object].push_back(&patch);
      }
      EXPECT_EQ(objects.count(0), 0U);
      for (const auto& [object, parts] : objects) {
        EXPECT_GE(parts.size(), 5U);
        for (const Patch* part : parts) EXPECT_EQ(part->motion.velocity, parts[0]->motion.velocity);
      }
      movers += objects.size();
    }
  }
  EXPECT_GE(movers, 40U);
}

TEST(Landscapes, InSomeNothingMoves) {
  std::set<bool> moving;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Scenario scenario = park(seed);
    moving.insert(std::any_of(scenario.scene.patches.begin(), scenario.scene.patches.end(),
                              [](const Patch& patch) { return patch.kind == PatchKind::kMover; }));
  }
  EXPECT_EQ(moving.size(), 2U);
}

TEST(Scene, PartsOfAMoverShareItsNumber) {
  Scenario scenario = plainFlight();
  const Eigen::Vector2d at = inTheMiddle(scenario);
  for (const double aside_m : {-2.0, -1.0, 1.0}) {
    Patch patch = upright(PatchKind::kMover, at + Eigen::Vector2d(0, aside_m));
    patch.motion.velocity = {0, 0.1, 0};
    patch.object = aside_m < 0 ? 7 : 0;
    scenario.scene.patches.push_back(patch);
  }
  const RenderedImage image = FlightSimulator(scenario).frame(0).image;
  const std::array<int, 3> numbers{1, 1, 2};
  for (size_t patch = 0; patch < numbers.size(); ++patch) {
    const cv::Mat1b pixels = image.surface == 1 + static_cast<int>(patch);
    ASSERT_GT(cv::countNonZero(pixels), 100);
    EXPECT_EQ(cv::countNonZero(pixels & (image.id == numbers[patch])), cv::countNonZero(pixels));
    EXPECT_EQ(cv::countNonZero(pixels & (image.mask == kMaskMoving)), cv::countNonZero(pixels));
  }
}

TEST(Scene, WhatSwaysGoesToAndFroAndIsBackground) {
  Scenario scenario = plainFlight();
  scenario.frames = 48;
  const Eigen::Vector2d at = inTheMiddle(scenario);
  Patch still = upright(PatchKind::kFront, at - Eigen::Vector2d(0, 1.5));
  Patch leaves = upright(PatchKind::kFront, at + Eigen::Vector2d(0, 1.5));
  leaves.shape = PatchShape::kFoliage;
  leaves.sway = Sway{{0, 0.3, 0}, 1, 0};
  scenario.scene.patches = {still, leaves};
  const FlightSimulator flight(scenario);
  double least = 1e9, most = -1e9;
  for (int k = 0; k < 24; k += 3) {  // one period
    const double apart_px = std::abs(columnOf(flight, k, 1) - columnOf(flight, k, 0));
    least = std::min(least, apart_px);
    most = std::max(most, apart_px);
    EXPECT_EQ(cv::countNonZero(flight.frame(k).image.mask), 0);
  }
  EXPECT_GT(most, least + 10);
}

TEST(Scene, WhatIsRoundTurnsToTheCamera) {
  Scenario scenario = plainFlight();
  scenario.scene.patches = {upright(PatchKind::kFront, inTheMiddle(scenario))};
  scenario.scene.patches[0].axis_u = Eigen::Vector3d::UnitX();  // along the line of sight
  const int thin = cv::countNonZero(FlightSimulator(scenario).frame(0).image.surface == 1);
  scenario.scene.patches[0].is_round = true;
  EXPECT_GT(cv::countNonZero(FlightSimulator(scenario).frame(0).image.surface == 1), 5 * thin);
}

TEST(Scene, AShadowIsGroundInLessLight) {
  Scenario scenario = plainFlight();
  scenario.scene.patches = {upright(PatchKind::kFront, inTheMiddle(scenario))};
  const RenderedImage lit = FlightSimulator(scenario).frame(0).image;
  scenario.scene.sun = Eigen::Vector3d(-1, 1, 1).normalized();
  scenario.scene.shadow_gain = 0.5;
  const RenderedImage image = FlightSimulator(scenario).frame(0).image;
  EXPECT_TRUE(same(image.surface, lit.surface));
  cv::Mat1b darker = lit.grey != image.grey;
  EXPECT_GT(cv::countNonZero(darker), 200);
  EXPECT_EQ(cv::countNonZero(darker & (image.surface != kSurfaceGround)), 0);
  EXPECT_NEAR(cv::mean(image.grey, darker)[0] / cv::mean(lit.grey, darker)[0], 0.5, 0.01);
}

}  // namespace
}  // namespace redbee::simulation
