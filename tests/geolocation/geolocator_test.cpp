// Targets over time: who moves, stops, is hidden, leaves the image, comes back.
#include "redbee/geolocation/geolocator.hpp"

#include <gtest/gtest.h>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/chi_square.hpp"
#include "tests/geolocation/simulated_watch.hpp"

namespace redbee::test {
namespace {

class GeolocatorTest : public testing::Test {
 protected:
  static constexpr double kStep_s = 0.1;
  GeolocatorTest() {
    view_.R_EC = lookingNorth(45 * kDegree, 0);
    view_.position = {0, -40};
    view_.height_m = 40;
    view_.height_sigma_m = 0.2;
    view_.position_covariance.setIdentity();
    view_.attitude_covariance = std::pow(0.5 * kDegree, 2) * Eigen::Matrix3d::Identity();
  }
  /// A frame in which the object stands at `place`.
  std::vector<Target> show(int id, const Eigen::Vector2d& place, bool seen = true) {
    const auto pixel = pixelOf(*camera_, view_, {place.x(), place.y(), 0}).value();
    return step({{id, boxStandingAt(pixel, 30, *camera_, view_, 1), seen}});
  }
  std::vector<Target> step(const std::vector<ObservedBox>& boxes, bool has_view = true) {
    time_s_ += kStep_s;
    return geolocator_.step(CameraTime(fromSeconds(time_s_)), has_view ? std::optional(view_) : std::nullopt,
                            boxes);
  }
  /// Walks north at 2 m/s and ends at `to`.
  std::vector<Target> walkTo(int id, const Eigen::Vector2d& to, int frames = 30) {
    std::vector<Target> targets;
    for (int k = frames - 1; k >= 0; --k) targets = show(id, to - Eigen::Vector2d(0, 2 * kStep_s * k));
    return targets;
  }

  std::unique_ptr<const CameraModel> camera_ = makeCameraModel(watchingCamera());
  GroundView view_;
  Geolocator geolocator_{watchingCamera(), watchParameters()};
  double time_s_ = 100;
};

TEST_F(GeolocatorTest, MeasuresPlaceVelocityAndSize) {
  const auto targets = walkTo(3, {2, 5});
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].id, 3);
  EXPECT_EQ(targets[0].state, TargetState::kMoving);
  EXPECT_NEAR((targets[0].position - Eigen::Vector2d(2, 5)).norm(), 0, 0.05);
  EXPECT_NEAR((targets[0].velocity - Eigen::Vector2d(0, 2)).norm(), 0, 0.05);
  EXPECT_NEAR(targets[0].size.x(), 30 * targets[0].range_m / 1000, 0.1);
  EXPECT_EQ(targets[0].unseen_s, 0);
}

TEST_F(GeolocatorTest, WhoStopsKeepsItsPlace) {
  walkTo(3, {2, 5});
  auto targets = show(3, {2, 5}, false);
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].state, TargetState::kCoasting);
  EXPECT_NEAR(targets[0].unseen_s, kStep_s, 1e-9);
  for (int k = 0; k < 25; ++k) targets = step({});
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].state, TargetState::kStopped);
  EXPECT_EQ(targets[0].velocity.norm(), 0);
  const Eigen::Vector2d place = targets[0].position;
  EXPECT_NEAR((place - Eigen::Vector2d(2, 5)).norm(), 0, 0.6);  // half of what it was believed to go on
  for (int k = 0; k < 300; ++k) targets = step({});
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].position, place);
  for (int k = 0; k < 300; ++k) targets = step({});
  EXPECT_TRUE(targets.empty()) << "after keep_stopped_s it is forgotten";
}

TEST_F(GeolocatorTest, KeepsNoMoreThanAMessageListsAndForgetsWhoWasUnseenLongest) {
  std::vector<Target> targets;
  for (int id = 0; id < 1040; ++id) {
    const auto pixel = pixelOf(*camera_, view_, {(id % 20) - 10.0, (id / 20) % 10 * 2.0, 0}).value();
    targets = geolocator_.step(CameraTime(fromSeconds(100 + 0.001 * id)), view_,
                               {{id, boxStandingAt(pixel, 30, *camera_, view_, 1), true}});
  }
  ASSERT_EQ(targets.size(), 1024U);
  EXPECT_EQ(targets.front().id, 16);
  EXPECT_EQ(targets.back().id, 1039);
}

TEST_F(GeolocatorTest, ANewIdentityAtItsPlaceReplacesWhoStopped) {
  walkTo(3, {2, 5});
  for (int k = 0; k < 30; ++k) step({});
  const auto targets = show(8, {2, 6});
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].id, 8);
  for (int k = 0; k < 30; ++k) step({});
  EXPECT_EQ(show(9, {-10, -5}).size(), 2U) << "elsewhere it is another object";
}

TEST_F(GeolocatorTest, WhoLeavesTheImageHasNotStopped) {
  walkTo(3, {2, 5});
  view_.R_EC = lookingNorth(45 * kDegree, 0);
  view_.position = {100, -40};  // the camera looks elsewhere
  std::vector<Target> targets;
  for (int k = 0; k < 19; ++k) targets = step({});
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].state, TargetState::kCoasting);
  for (int k = 0; k < 3; ++k) targets = step({});
  EXPECT_TRUE(targets.empty());
}

TEST_F(GeolocatorTest, WithoutAViewNobodyStops) {
  walkTo(3, {2, 5});
  std::vector<Target> targets;
  for (int k = 0; k < 30; ++k) targets = step({}, false);
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].state, TargetState::kCoasting);
}

TEST_F(GeolocatorTest, RefusesTheHorizonAndFeetOutsideTheImage) {
  view_.R_EC = lookingNorth(2 * kDegree, 0);
  EXPECT_TRUE(step({{1, {600, 100, 30, 30}, true}}).empty());
  EXPECT_EQ(geolocator_.refused().above_horizon, 1);
  view_.R_EC = lookingNorth(45 * kDegree, 0);
  EXPECT_TRUE(step({{1, {600, 660, 30, 60}, true}}).empty());
  EXPECT_EQ(geolocator_.refused().cut_off, 1);
  EXPECT_EQ(geolocator_.refused().above_horizon, 0);
}

TEST_F(GeolocatorTest, OneWildBoxDoesNotMoveATargetFiveDo) {
  walkTo(3, {2, 5});
  auto targets = show(3, {15, 15});
  EXPECT_NEAR((targets[0].position - Eigen::Vector2d(2, 5)).norm(), 0, 1);
  for (int k = 0; k < 5; ++k) targets = show(3, {15, 15});
  EXPECT_NEAR((targets[0].position - Eigen::Vector2d(15, 15)).norm(), 0, 0.5);
}

TEST_F(GeolocatorTest, AClockThatWasSetForgets) {
  walkTo(3, {2, 5});
  time_s_ -= 50;
  EXPECT_TRUE(step({}).empty());
}

TEST_F(GeolocatorTest, ALensThatZoomsMovesNobody) {
  for (int k = 0; k < 30; ++k) {
    const double zoom = 1 + 0.05 * k;
    camera_ = makeCameraModel(zoomed(watchingCamera(), zoom));
    geolocator_.setZoom(zoom);
    const auto pixel = pixelOf(*camera_, view_, {2, 5, 0}).value();
    const auto targets = step({{3, boxStandingAt(pixel, 30 * zoom, *camera_, view_, 1), true}});
    ASSERT_EQ(targets.size(), 1U);
    EXPECT_NEAR((targets[0].position - Eigen::Vector2d(2, 5)).norm(), 0, 0.05) << zoom;
    EXPECT_NEAR(targets[0].velocity.norm(), 0, 0.05) << zoom;
    EXPECT_NEAR(targets[0].size.x(), 30 * targets[0].range_m / 1000, 0.1) << zoom;
  }
}

/// A lens that fell silent while it zoomed on by a fifth.
TEST_F(GeolocatorTest, AGuessedZoomIsInTheCovariance) {
  const double zoom = 1.2, sigma = 0.2;
  camera_ = makeCameraModel(zoomed(watchingCamera(), zoom));
  const Eigen::Vector2d place(15, 12);
  const auto distanceWith = [&](double variance) {
    geolocator_.restart();
    geolocator_.setZoom(1, variance);
    const auto targets = show(3, place);
    const Eigen::Vector2d error = targets.at(0).position - place;
    return error.dot(targets[0].position_covariance.inverse() * error);
  };
  EXPECT_GT(distanceWith(0), chiSquareQuantile(0.99, 2)) << "what is believed without it";
  EXPECT_LT(distanceWith(sigma * sigma), chiSquareQuantile(0.9, 2));
}

/// Each frame tells the same: where it is believed does not get better by looking longer.
TEST_F(GeolocatorTest, AGuessedZoomDoesNotAverageOut) {
  geolocator_.setZoom(1, 0.2 * 0.2);
  const double first = show(3, {15, 12}).at(0).position_covariance.trace();
  double last = 0;
  for (int k = 0; k < 50; ++k) last = show(3, {15, 12}).at(0).position_covariance.trace();
  EXPECT_GT(last, 0.9 * first);
}

}  // namespace
}  // namespace redbee::test
