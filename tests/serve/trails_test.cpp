// Trails stay where they are on the ground; the footprint is where the image's corners meet it.
#include "processes/serve/trails.hpp"

#include <gtest/gtest.h>

#include "processes/serve/map_view.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {
namespace {

detections_t boxAt(int64_t utime, int32_t id, int x, int y) {
  detections_t m{};
  m.utime = utime;
  m.n = 1;
  m.detections.resize(1);
  m.detections[0] = {id, x, y, 21, 31, 0, 1, 1};
  return m;
}

Eigen::Matrix3d shift(double dx, double dy) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = dx;
  H(1, 2) = dy;
  return H;
}

TEST(Trails, AreCarriedAlongByTheGround) {
  Trails trails(camera());
  trails.addDetections(boxAt(1000, 7, 100, 200));
  trails.addStep(1000, 2000, shift(5, -3));
  trails.addStep(2000, 3000, shift(1, 1));  // of a frame whose detections are yet to come
  trails.addDetections(boxAt(2000, 7, 120, 200));
  trails.addDetections(boxAt(3000, 7, 130, 200));
  const auto result = trails.trails();
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].id, 7);
  // The middle of the lower edge: x + 10, y + 30.
  const std::vector<Eigen::Vector2d> expected{{110 + 5 + 1, 230 - 3 + 1}, {130 + 1, 230 + 1}, {140, 230}};
  ASSERT_EQ(result[0].points.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_LT((result[0].points[i] - expected[i]).norm(), 1e-9);
}

TEST(Trails, EndWhereAStepIsMissing) {
  Trails trails(camera());
  trails.addDetections(boxAt(1000, 7, 100, 200));
  trails.addStep(1000, 2000, shift(5, 0));
  trails.addDetections(boxAt(3000, 7, 100, 200));
  EXPECT_TRUE(trails.trails().empty());
}

TEST(Trails, AreFiveSecondsLong) {
  Trails trails(camera());
  for (int64_t k = 0; k < 200; ++k) {
    trails.addStep((k - 1) * 100'000 + 1, k * 100'000 + 1, shift(0, 0));
    trails.addDetections(boxAt(k * 100'000 + 1, 3, 100, 200));
  }
  EXPECT_EQ(trails.trails()[0].points.size(), 50U);
}

TEST(Trails, ReturnAfterTheClockWasSetBack) {
  Trails trails(camera());
  const auto addFrames = [&](int64_t from) {
    trails.addDetections(boxAt(from, 3, 100, 200));
    for (int64_t utime = from; utime < from + 10'000'000; utime += 100'000) {
      trails.addStep(utime, utime + 100'000, shift(0, 0));
      trails.addDetections(boxAt(utime + 100'000, 3, 100, 200));
    }
  };
  addFrames(1'000'000'000);
  trails.addStep(900'000'000 - 100'000, 900'000'000, shift(0, 0));
  trails.addDetections(boxAt(900'000'000, 3, 100, 200));
  EXPECT_TRUE(trails.trails().empty());
  addFrames(900'000'000);
  ASSERT_EQ(trails.trails().size(), 1U);
  EXPECT_EQ(trails.trails()[0].points.size(), 50U);
}

TEST(Footprint, IsWhereTheCornersMeetTheGround) {
  // Straight down from 10 m, the image's top to the north: x east, y south, z down.
  Eigen::Matrix3d R_GC;
  R_GC << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const auto corners = footprintOf(camera(), R_GC, 10);
  ASSERT_EQ(corners.size(), 4U);
  const double half_width = 10 * 319.5 / 500;
  const double half_height = 10 * 239.5 / 500;
  EXPECT_LT((corners[0] - Eigen::Vector2d(-half_width, half_height)).norm(), 1e-9);
  EXPECT_LT((corners[2] - Eigen::Vector2d(half_width, -half_height)).norm(), 1e-9);
}

TEST(Footprint, EndsBelowTheHorizonAndIsRefusedAboveIt) {
  // Level, to the north: the lower corners meet the ground, the upper ones do not.
  Eigen::Matrix3d R_GC;
  R_GC << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const auto corners = footprintOf(camera(), R_GC, 10);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR(corners[0].norm(), 10 / std::tan(5 * M_PI / 180), 1e-6);
  EXPECT_NEAR(corners[2].y(), 10 * 500 / 239.5, 1e-6);
  const Eigen::Matrix3d up = R_GC * expSO3({60 * M_PI / 180, 0, 0});
  EXPECT_TRUE(footprintOf(camera(), up, 10).empty());
}

pose_t poseAt(int64_t utime, double east, double north) {
  pose_t pose{};
  pose.utime = utime;
  pose.quat[0] = 1;
  pose.has_local = 1;
  pose.local[0] = east;
  pose.local[1] = north;
  pose.has_home_altitude = 1;
  pose.home_altitude = 12;
  return pose;
}

/// On WGS-84 alone.
pose_t poseAtPlace(double latitude, double longitude) {
  pose_t pose = poseAt(0, 0, 0);
  pose.has_local = 0;
  pose.has_global = 1;
  pose.latitude = latitude;
  pose.longitude = longitude;
  return pose;
}

TEST(Map, SaysWhatIsMissing) {
  Configuration configuration;
  configuration.camera = intrinsics();
  MapBuilder map(configuration);
  EXPECT_EQ(map.view(1'000'000).note.substr(0, 7), "no POSE");
  map.onPose(poseAt(1'000'000, 3, 4));
  const MapView view = map.view(1'100'000);
  ASSERT_TRUE(view.own);
  EXPECT_EQ(view.own->position, Eigen::Vector2d(3, 4));
  EXPECT_DOUBLE_EQ(view.own->heading_rad, M_PI / 2);  // body x, forward, to the east
  EXPECT_EQ(map.view(4'000'000).note, "POSE is 3.0 s old: what is drawn is where the drone was");
}

TEST(Map, MeasuresMetresFromTheFirstFixWhereThereIsNoLocalPosition) {
  Configuration configuration;
  configuration.camera = intrinsics();
  MapBuilder map(configuration);
  map.onPose(poseAtPlace(60, 10));
  map.onPose(poseAtPlace(60.001, 10.001));
  const auto view = map.view(0);
  ASSERT_TRUE(view.own);
  // WGS-84: a degree of latitude is 111.41 km at 60 degrees, one of longitude 55.80 km.
  EXPECT_NEAR(view.own->position.y(), 111.41, 0.01);
  EXPECT_NEAR(view.own->position.x(), 55.80, 0.01);
}

TEST(Map, MeasuresAcrossTheDateLine) {
  Configuration configuration;
  configuration.camera = intrinsics();
  MapBuilder map(configuration);
  map.onPose(poseAtPlace(60, 179.9995));
  map.onPose(poseAtPlace(60, -179.9995));
  const auto view = map.view(0);
  ASSERT_TRUE(view.own);
  EXPECT_NEAR(view.own->position.x(), 55.80, 0.01);
}

}  // namespace
}  // namespace redbee::test
