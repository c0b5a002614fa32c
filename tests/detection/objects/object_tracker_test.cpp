#include "redbee/detection/objects/object_tracker.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

const cv::Size kImage(640, 480);
const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

Detection component(int x, int y) {
  Detection detection;
  detection.box = {x, y, 20, 30};
  detection.area_px = 400;
  detection.score = 0.5;
  return detection;
}

ObjectParameters atOnce() {
  ObjectParameters parameters;
  parameters.confirm_frames = 1;
  return parameters;
}

TEST(ObjectTracker, MoverThatStopsKeepsItsIdentity) {
  const ObjectParameters parameters = atOnce();
  ObjectTracker tracker(parameters);
  int x = 100;
  int id = 0;
  for (int k = 0; k < 20; ++k, x += 3) {
    tracker.propagate(kStill);
    id = tracker.update({component(x, 200)}, kImage).at(0).id;
  }
  for (int k = 0; k < parameters.max_missed_frames; ++k) {
    tracker.propagate(kStill);
    const auto tracks = tracker.update({}, kImage);
    ASSERT_EQ(tracks.size(), 1U) << "lost after " << k << " frames";
    EXPECT_FALSE(tracks[0].seen);
    EXPECT_EQ(tracks[0].id, id);
  }
  tracker.propagate(kStill);
  const auto tracks = tracker.update({component(x, 200)}, kImage);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, id);
  EXPECT_TRUE(tracks[0].seen);
}

TEST(ObjectTracker, IdentityEndsAfterMaxMissedFrames) {
  const ObjectParameters parameters = atOnce();
  ObjectTracker tracker(parameters);
  tracker.update({component(100, 200)}, kImage);
  for (int k = 0; k < parameters.max_missed_frames; ++k) tracker.update({}, kImage);
  EXPECT_TRUE(tracker.update({}, kImage).empty());
}

TEST(ObjectTracker, SkippedFramesDoNotCountAsMissed) {
  const ObjectParameters parameters = atOnce();
  ObjectTracker tracker(parameters);
  const int id = tracker.update({component(100, 200)}, kImage).at(0).id;
  for (int k = 0; k < parameters.max_missed_frames; ++k) {
    const auto tracks = tracker.skip(kImage);
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_FALSE(tracks[0].seen);
  }
  for (int k = 0; k < parameters.max_missed_frames; ++k) tracker.update({}, kImage);
  const auto tracks = tracker.update({component(104, 200)}, kImage);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, id);
}

TEST(ObjectTracker, TracksAreDeletedAfterTooManySkippedFrames) {
  const ObjectParameters parameters = atOnce();
  ObjectTracker tracker(parameters);
  tracker.update({component(100, 200)}, kImage);
  for (int k = 0; k < 2 * parameters.max_missed_frames; ++k) ASSERT_EQ(tracker.skip(kImage).size(), 1U);
  EXPECT_TRUE(tracker.skip(kImage).empty());
}

TEST(ObjectTracker, AnUnconfirmedTrackDoesNotSurviveSkippedFrames) {
  ObjectParameters parameters;
  parameters.confirm_frames = 2;
  ObjectTracker tracker(parameters);
  tracker.update({component(100, 200)}, kImage);
  tracker.skip(kImage);
  EXPECT_TRUE(tracker.update({component(100, 200)}, kImage).empty());
}

TEST(ObjectTracker, FollowsTheGroundWhileTheCameraMoves) {
  ObjectTracker tracker(atOnce());
  const int id = tracker.update({component(100, 200)}, kImage).at(0).id;
  Eigen::Matrix3d pan = kStill;
  pan(0, 2) = 50;
  for (int k = 0; k < 5; ++k) {
    tracker.propagate(pan);
    tracker.update({}, kImage);
  }
  const auto tracks = tracker.update({component(350, 200)}, kImage);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].id, id);
}

TEST(ObjectTracker, TwoObjectsThatPassKeepTheirIdentities) {
  ObjectTracker tracker(atOnce());
  std::vector<Detection> tracks;
  int left = 0;
  int right = 0;
  for (int k = 0; k < 30; ++k) {
    tracker.propagate(kStill);
    tracks = tracker.update({component(100 + 6 * k, 200), component(300 - 6 * k, 225)}, kImage);
    ASSERT_EQ(tracks.size(), 2U);
    if (k == 0) {
      left = tracks[0].id;
      right = tracks[1].id;
    }
  }
  for (const Detection& detection : tracks) EXPECT_EQ(detection.id, detection.box.y == 200 ? left : right);
}

TEST(ObjectTracker, FlickerIsNotConfirmed) {
  ObjectParameters parameters;
  parameters.confirm_frames = 3;
  ObjectTracker tracker(parameters);
  EXPECT_TRUE(tracker.update({component(100, 200)}, kImage).empty());
  EXPECT_TRUE(tracker.update({component(101, 200)}, kImage).empty());
  EXPECT_EQ(tracker.update({component(102, 200)}, kImage).size(), 1U);
}

TEST(FindComponents, SmallAndUnknownRegionsAreNoObjects) {
  ObjectParameters parameters;
  cv::Mat probability = cv::Mat::zeros(kImage, CV_8U);
  probability(cv::Rect(100, 100, 20, 30)).setTo(204);
  probability(cv::Rect(300, 100, 4, 4)).setTo(204);
  probability(cv::Rect(500, 100, 20, 30)).setTo(204);
  cv::Mat unknown = cv::Mat::zeros(kImage, CV_8U);
  unknown(cv::Rect(480, 80, 80, 80)).setTo(255);
  const ForegroundComponents found = findComponents(probability, unknown, parameters);
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].box, cv::Rect(100, 100, 20, 30));
  EXPECT_NEAR(found.components[0].score, 0.8, 0.01);
  EXPECT_EQ(cv::countNonZero(found.mask), found.components[0].area_px);
}

TEST(FindComponents, AnObjectReachesAsFarAsTheLowerThresholdAndIsSureSomewhere) {
  ObjectParameters parameters;
  parameters.threshold = 0.5;
  parameters.extent_threshold = 0.3;
  cv::Mat probability = cv::Mat::zeros(kImage, CV_8U);
  probability(cv::Rect(100, 100, 20, 30)).setTo(100);  // 0.39
  probability(cv::Rect(105, 105, 4, 4)).setTo(200);
  probability(cv::Rect(300, 100, 20, 30)).setTo(100);
  const ForegroundComponents found = findComponents(probability, cv::Mat::zeros(kImage, CV_8U), parameters);
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].box, cv::Rect(100, 100, 20, 30));
}

}  // namespace
}  // namespace redbee
