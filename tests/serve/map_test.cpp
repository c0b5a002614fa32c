// The map of the page from POSE and TARGETS whose geometry is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "processes/geolocation/target_messages.hpp"
#include "processes/serve/flight_map.hpp"
#include "processes/serve/live_map.hpp"
#include "processes/serve/map_json.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
constexpr int64_t kStart_us = 1'000'000'000;
constexpr int64_t kShift_us = 20'000;  // of TargetFlight
constexpr double kCentimetre = 0.011;  // to which positions are rounded

int64_t utimeAt(double t) { return kStart_us + std::llround(t * 1e6); }
pose_t poseAt(double t, bool has_global = true) {
  return TargetFlight::pose(utimeAt(t) + kShift_us, t, has_global);
}

/// Three sigma along a course of 30 degrees, one across.
Eigen::Matrix2d knownCovariance() {
  const Eigen::Vector2d along(std::sin(30 * kDegree), std::cos(30 * kDegree));
  return Eigen::Matrix2d::Identity() + 8 * along * along.transpose();
}

/// One target of each state, 10, 20 and 30 m east and 40 m north of where TARGETS counts from.
targets_t targetsAt(double t, const LocalFrame& frame) {
  targets_t message{};
  message.utime = utimeAt(t);
  message.sequence = static_cast<int32_t>(t * TargetFlight::kRate_hz);
  message.has_global = frame.isGlobal() ? 1 : 0;
  for (const auto state : {TargetState::kMoving, TargetState::kStopped, TargetState::kCoasting}) {
    Target target;
    target.id = 5 + static_cast<int>(state);
    target.state = state;
    target.position = {10.0 * (1 + static_cast<int>(state)), 40};
    target.velocity = {3, -4};
    target.position_covariance = knownCovariance();
    target.velocity_covariance.setIdentity();
    target.size = {0.5, 1.8};
    message.targets.push_back(messageOf(target, frame));
  }
  message.n = static_cast<int32_t>(message.targets.size());
  return message;
}

/// As of the flight's take-off where there are no local positions.
LocalFrame frameFrom(double east_m) {
  LocalFrame frame;
  VehiclePose pose;
  pose.global = TargetFlight::placeOf({east_m, 0});
  frame.placeOf(pose);
  return frame;
}

Eigen::Vector2d pointOf(const json& point) { return {point.at(0).get<double>(), point.at(1).get<double>()}; }

TEST(Map, HasTargetsWithStateSpeedEllipseAndPlace) {
  MapBuilder map(TargetFlight::configuration());
  map.onPose(poseAt(0));
  const targets_t targets = targetsAt(0, frameFrom(0));
  map.onTargets(targets);
  const json shown = mapJson(map.view(utimeAt(0)));
  ASSERT_EQ(shown["targets"].size(), 3U);
  EXPECT_EQ(shown["targets_utime"], utimeAt(0));
  EXPECT_EQ(shown["note"], "");
  const char* states[] = {"moving", "stopped", "coasting"};
  for (int i = 0; i < 3; ++i) {
    const json& target = shown["targets"][static_cast<size_t>(i)];
    EXPECT_EQ(target["id"], 5 + i);
    EXPECT_EQ(target["state"], states[i]);
    EXPECT_LT((pointOf(target["position"]) - Eigen::Vector2d(10 * (i + 1), 40)).norm(), kCentimetre);
    EXPECT_EQ(pointOf(target["velocity"]), Eigen::Vector2d(3, -4));
    EXPECT_NEAR(target["speed"], 5, 1e-9);
    EXPECT_NEAR(target["ellipse"]["major"], 3, 1e-6);
    EXPECT_NEAR(target["ellipse"]["minor"], 1, 1e-6);
    const double course = std::fmod(target["ellipse"]["angle"].get<double>() + 2 * M_PI, M_PI);
    EXPECT_NEAR(course, 30 * kDegree, 1e-6);
    EXPECT_EQ(target["latitude"], targets.targets[static_cast<size_t>(i)].latitude);
    EXPECT_EQ(target["longitude"], targets.targets[static_cast<size_t>(i)].longitude);
  }
}

TEST(Map, PutsTargetsThatCountFromAnotherPlaceWhereTheyAre) {
  MapBuilder map(TargetFlight::configuration());
  map.onPose(poseAt(0));
  // The geolocation started a hundred metres further east, and there is no place of take-off.
  map.onTargets(targetsAt(0, frameFrom(100)));
  const json shown = mapJson(map.view(utimeAt(0)));
  EXPECT_LT((pointOf(shown["targets"][0]["position"]) - Eigen::Vector2d(110, 40)).norm(), kCentimetre);
}

TEST(Map, WithoutSatellitesCountsFromTheSamePlace) {
  MapBuilder map(TargetFlight::configuration());
  map.onPose(poseAt(2, false));
  targets_t targets = targetsAt(1.9, LocalFrame());
  targets.has_view = 1;
  targets.camera_height = 40;
  targets.camera_axis[2] = -1;
  map.onTargets(targets);
  const json shown = mapJson(map.view(utimeAt(2)));
  EXPECT_LT((pointOf(shown["targets"][0]["position"]) - Eigen::Vector2d(10, 40)).norm(), kCentimetre);
  EXPECT_FALSE(shown["targets"][0].contains("latitude"));
}

TEST(Map, TargetsWhosePlaceIsNotKnownLieAsSeenFromTheDrone) {
  MapBuilder map(TargetFlight::configuration());
  const double t = 2;
  map.onPose(poseAt(t));  // the drone is 6 m east of its origin and flies east at 3 m/s
  // A geolocation that was restarted, and has had no fix since.
  targets_t targets = targetsAt(t - 0.1, LocalFrame());
  targets.has_view = 1;
  targets.camera_position[0] = 1005.7;  // by another origin, when the frame was taken
  targets.camera_position[1] = -500;
  targets.camera_height = 40;
  targets.camera_axis[2] = -1;
  map.onTargets(targets);
  const json shown = mapJson(map.view(utimeAt(t)));
  EXPECT_LT((pointOf(shown["targets"][0]["position"]) - Eigen::Vector2d(-990, 540)).norm(), kCentimetre);
}

TEST(Map, TheCameraLooksWhereTargetsSayIt) {
  Configuration configuration = TargetFlight::configuration();
  configuration.geolocation.mount = "gimbal";
  MapBuilder map(configuration);
  map.onPose(poseAt(0));
  EXPECT_THAT(map.view(utimeAt(0)).note, HasSubstr("gimbal"));
  EXPECT_THAT(map.view(utimeAt(0)).footprint, IsEmpty()) << "R_CI says nothing of a gimbal";
  targets_t targets = targetsAt(0, frameFrom(0));
  targets.has_view = targets.has_footprint = 1;
  targets.camera_height = 25;
  targets.camera_axis[0] = std::sqrt(0.5);  // east, 45 degrees down
  targets.camera_axis[2] = -std::sqrt(0.5);
  fillFootprint(targets, (Eigen::Matrix<double, 2, 4>() << 50, 50, 15, 15, 20, -20, -9, 9).finished());
  map.onTargets(targets);
  json shown = mapJson(map.view(utimeAt(0)));
  EXPECT_EQ(shown["footprint"], json({{50, 20}, {50, -20}, {15, -9}, {15, 9}}));
  EXPECT_NEAR(shown["own"]["height"], 25, 1e-9);
  EXPECT_LT((pointOf(shown["own"]["axis"]) - Eigen::Vector2d(25, 0)).norm(), kCentimetre);
  // Where a corner sees no ground, the footprint is cut off in the direction of the camera.
  targets.has_footprint = 0;
  map.onTargets(targets);
  shown = mapJson(map.view(utimeAt(0)));
  ASSERT_EQ(shown["footprint"].size(), 4U);
  for (const json& corner : shown["footprint"]) EXPECT_GT(corner[0], 5) << "east of the drone";
  EXPECT_NEAR(shown["footprint"][0][1], -shown["footprint"][1][1].get<double>(), 0.2) << "a level image";
}

TEST(Map, SaysWhatIsWrongWithTargets) {
  MapBuilder map(TargetFlight::configuration());
  map.onPose(poseAt(0));
  targets_t targets = targetsAt(0, frameFrom(0));
  for (const auto& [status, words] : {std::pair{targets_t::NO_POSE, "no POSE"},
                                      {targets_t::STALE_POSE, "no POSE near the frame"},
                                      {targets_t::NO_POSITION, "no position"},
                                      {targets_t::NO_MOUNT, "no GIMBAL"},
                                      {targets_t::NO_HEIGHT, "no height"},
                                      {targets_t::OTHER_CAMERA, "another camera"}}) {
    targets.status = status;
    map.onTargets(targets);
    EXPECT_THAT(map.view(utimeAt(0)).note, HasSubstr(words));
    EXPECT_THAT(map.view(utimeAt(0)).note, HasSubstr("predicted"));
  }
  map.onPose(poseAt(3));
  EXPECT_THAT(map.view(utimeAt(3)).note, HasSubstr("no TARGETS for 3.0 s"));
  EXPECT_THAT(map.view(utimeAt(3)).targets, IsEmpty());
}

TEST(FlightMap, IsTheSameFromASnapshotAsFromTheTakeOff) {
  FlightMap flight(TargetFlight::configuration());
  MapBuilder straight(TargetFlight::configuration());
  for (int k = 0; k < 2500; ++k) flight.add(poseAt(k * 0.02));
  flight.add(targetsAt(45, frameFrom(0)));
  flight.finish();
  int poses = 0;
  for (const double t : {0.0, 19.97, 19.99, 20.01, 45.0}) {
    for (; poses * 0.02 <= t; ++poses) straight.onPose(poseAt(poses * 0.02));
    const MapView shown = flight.at(utimeAt(t));
    ASSERT_TRUE(shown.own) << t;
    EXPECT_NEAR(shown.own->position.x(), 3 * t, 3 * 0.021) << t;
    EXPECT_EQ(shown.path, straight.view(utimeAt(t)).path) << t;
    EXPECT_EQ(shown.targets.size(), t < 45 ? 0U : 3U) << t;
  }
  EXPECT_EQ(flight.at(utimeAt(45.5)).targets.size(), 3U) << "those of the last frame that has some";
  EXPECT_EQ(flight.at(utimeAt(47)).targets.size(), 0U);
}

TEST(LiveMap, IsRenewedByPoseAndTargetsToo) {
  LiveMap map(TargetFlight::configuration());
  LiveMap::Time now{};
  const auto next = [&] {
    now += LiveMap::kPeriod;
    const auto text = map.takeText(now);
    return text ? json::parse(*text) : json();
  };
  EXPECT_TRUE(next().is_null()) << "nothing has come";
  map.onPose(poseAt(0));
  EXPECT_THAT(next()["note"].get<std::string>(), HasSubstr("redbee-geolocation does not answer"));
  map.onTargets(targetsAt(0, frameFrom(0)));
  const json shown = next();
  EXPECT_EQ(shown["targets"].size(), 3U);
  EXPECT_EQ(shown["note"], "");
  EXPECT_TRUE(next().is_null()) << "nothing is new";
  map.onPose(poseAt(5));
  EXPECT_THAT(next()["note"].get<std::string>(), HasSubstr("no TARGETS for 5.0 s"));
  map.onPose(poseAt(5.1));
  EXPECT_FALSE(map.takeText(now)) << "not more often than kPeriod";
  map.onFrame(utimeAt(8), now);
  EXPECT_THAT(next()["note"].get<std::string>(), HasSubstr("POSE is 2.9 s old"));
}

}  // namespace
}  // namespace redbee::test
