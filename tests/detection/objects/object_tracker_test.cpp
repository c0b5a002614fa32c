// Identities of tracks: through misses, stops, skipped frames and the camera's motion.
#include "redbee/detection/objects/object_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>
#include <set>

#include "redbee/geometry/homography.hpp"
#include "redbee/imaging/box_overlap.hpp"
#include "tests/support/tracked_objects.hpp"

namespace redbee::test {
namespace {

TEST(ObjectTracker, FollowsAConstantVelocityUnderAMovingCamera) {
  // A square of 0.8 m at 2 m/s over the ground, seen obliquely from a drone that advances, sinks and turns.
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  const double dt = 1.0 / 24;
  PlaneMotion motion;
  motion.R_ba = Eigen::AngleAxisd(0.3 * dt, Eigen::Vector3d(0, 0, 1)).toRotationMatrix();
  motion.t_ba = Eigen::Vector3d(0.5, 0, -1) * dt;
  motion.m_a = Eigen::Vector3d(0, 0.3, 1).normalized();
  motion.h_a = 10;
  const Eigen::Vector3d along(1, 0, 0);
  const Eigen::Vector3d across = motion.m_a.cross(along);
  Eigen::Vector3d object = motion.h_a * motion.m_a + 0.5 * across - along;  // a point of the ground, in C
  Eigen::Vector3d step = 2 * dt * (0.8 * along - 0.6 * across);
  Eigen::Vector3d side = 0.4 * along, other_side = 0.4 * across;
  TrackerFlight flight(atOnce());
  for (int k = 0; k < 36; ++k) {
    if (k > 0) {
      flight.propagate(dt, planeHomography(K, motion));
      object = motion.R_ba * (object + step) + motion.t_ba;
      for (Eigen::Vector3d* direction : {&step, &side, &other_side}) *direction = motion.R_ba * *direction;
      motion.m_a = motion.R_ba * motion.m_a;
      motion.h_a += motion.m_a.dot(motion.t_ba);
    }
    std::vector<cv::Point2f> corners;
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(object - side - other_side), Eigen::Vector3d(object + side - other_side),
          Eigen::Vector3d(object - side + other_side), Eigen::Vector3d(object + side + other_side)}) {
      const Eigen::Vector2d pixel = (K * corner).hnormalized();
      corners.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    }
    const cv::Rect truth = cv::boundingRect(corners);
    const bool is_missed = k > 24 && k < 28;
    const auto tracks = flight.update(is_missed ? Regions{} : Regions{{truth}});
    ASSERT_EQ(tracks.size(), 1U) << "frame " << k;
    EXPECT_EQ(tracks[0].id, 1);
    EXPECT_EQ(tracks[0].seen, !is_missed);
    EXPECT_GT(intersectionOverUnion(tracks[0].box, truth), is_missed ? 0.5 : 0.8) << "frame " << k;
  }
}

TEST(ObjectTracker, AMoverThatStopsKeepsItsIdentity) {
  TrackerFlight flight(atOnce());
  int x = 100;
  for (int k = 0; k < 24; ++k, x += 3) flight.step({{{x, 200, 20, 30}}});
  const int missed = static_cast<int>(0.9 * atOnce().max_missed_s * 24);
  for (int k = 0; k < missed; ++k) {
    const auto tracks = flight.step({});
    ASSERT_EQ(tracks.size(), 1U) << "lost after " << k << " frames";
    EXPECT_FALSE(tracks[0].seen);
    EXPECT_EQ(tracks[0].id, 1);
  }
  const auto tracks = flight.step({{{x, 200, 20, 30}}});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, 1);
  EXPECT_TRUE(tracks[0].seen);
}

TEST(ObjectTracker, AStoppedObjectStaysOnTheGroundWhileTheCameraMoves) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  Eigen::Matrix3d pan = kStill;
  pan(0, 2) = 10;
  for (int k = 0; k < 20; ++k) flight.step({}, pan);
  const auto tracks = flight.step({{{310, 200, 20, 30}}}, pan);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, 1);
}

TEST(ObjectTracker, AnIdentityEndsAfterMaxMissed) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  const int frames = static_cast<int>(atOnce().max_missed_s * 24) + 1;
  for (int k = 0; k < frames; ++k) flight.step({});
  EXPECT_TRUE(flight.step({}).empty());
}

TEST(ObjectTracker, SkippedFramesDoNotCountAsMissed) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  const int frames = static_cast<int>(0.9 * atOnce().max_missed_s * 24);
  for (int k = 0; k < frames; ++k) {
    const auto tracks = flight.skip();
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_FALSE(tracks[0].seen);
  }
  for (int k = 0; k < frames; ++k) flight.step({});
  const auto tracks = flight.step({{{104, 200, 20, 30}}});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, 1);
}

TEST(ObjectTracker, TracksAreDeletedAfterTooManySkippedFrames) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  const int frames = static_cast<int>(2 * atOnce().max_missed_s * 24);
  for (int k = 0; k < frames - 1; ++k) ASSERT_EQ(flight.skip().size(), 1U);
  for (int k = 0; k < 3; ++k) flight.skip();
  EXPECT_TRUE(flight.skip().empty());
}

TEST(ObjectTracker, FollowsTheGroundWithoutAHomographyForAMoment) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  for (int k = 0; k < 6; ++k) flight.skip();
  const auto tracks = flight.step({{{140, 210, 20, 30}}});
  ASSERT_EQ(tracks.size(), 1U) << "the camera's motion is unknown: the gate is wide";
  EXPECT_EQ(tracks[0].id, 1);
}

TEST(ObjectTracker, WhatLeavesTheImageIsNotKeptAtItsBorder) {
  TrackerFlight flight(atOnce());
  std::vector<Detection> tracks;
  for (int k = 0; k < 60; ++k) {
    tracks = flight.step({{{560 + 4 * k, 200, 20, 30}}});
    for (const Detection& track : tracks) EXPECT_LE(track.box.br().x, 640);
  }
  EXPECT_TRUE(tracks.empty());
}

TEST(ObjectTracker, ATimeThatDoesNotPassChangesNothing) {
  TrackerFlight flight(atOnce());
  flight.step({{{100, 200, 20, 30}}});
  flight.propagate(0, kStill);
  const auto tracks = flight.update({{{100, 200, 20, 30}}});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].box, cv::Rect(100, 200, 20, 30));
}

}  // namespace
}  // namespace redbee::test
