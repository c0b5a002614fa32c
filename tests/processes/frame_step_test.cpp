// The motion between frames that are no neighbours, composed of fused homographies with known values.
#include "processes/motion_segmentation/frame_step.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "processes/conversions.hpp"

namespace redbee::test {
namespace {

using Messages = MessageSynchronizer<fused_homography_t>;

CameraTime at(int frame) { return CameraTime(fromUtime(1'000'000 + frame * 40'000)); }

Eigen::Matrix3d shift(double x, double y) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = x;
  H(1, 2) = y;
  return H;
}

/// The ground moves by (2, 1) px a frame and the front plane by (5, 0); the camera by 1 m along x. Tracks:
/// a point of the ground, one of the front plane, and an object that moves by (0, 3) more than the ground.
fused_homography_t message(int frame, int tracked_from) {
  fused_homography_t m{};
  m.utime = toUtime(at(frame));
  m.utime_previous = toUtime(at(frame - 1));
  m.utime_tracks = toUtime(at(tracked_from));
  m.source = fused_homography_t::FUSED;
  const auto frames = static_cast<float>(frame - tracked_from);
  fill(m.step, shift(2, 1), Matrix8d::Zero());
  m.has_front = 1;
  fill(m.H_front, shift(5 * frames, 0));
  m.has_motion = 1;
  fill(m.motion, {Eigen::Matrix3d::Identity(), {1, 0, 0}, {0, 0, 1}, 10});
  fill(m.tracks,
       {{{10, 10}, {100, 50}, {60, 60}},
        {{10 + 2 * frames, 10 + frames}, {100 + 5 * frames, 50}, {60 + 2 * frames, 60 + 4 * frames}},
        3});
  return m;
}

Messages messagesOf(const std::vector<fused_homography_t>& all) {
  Messages messages(std::chrono::milliseconds(100), true);
  for (const fused_homography_t& m : all) messages.put(timeOf(m), m, timeOf(m));
  return messages;
}

void expectPoint(const cv::Point2f& point, double x, double y) {
  EXPECT_NEAR(point.x, x, 1e-4);
  EXPECT_NEAR(point.y, y, 1e-4);
}

TEST(FrameStep, OfNeighboursIsTheMessage) {
  const auto step = stepAlong(messagesOf({message(1, 0)}), at(0), at(1));
  ASSERT_TRUE(step);
  EXPECT_EQ(step->ground, shift(2, 1));
  EXPECT_EQ(step->front.value(), shift(5, 0));
  EXPECT_EQ(step->motion->t_ba, Eigen::Vector3d(1, 0, 0));
  expectPoint(step->tracks.previous[2], 60, 60);
}

TEST(FrameStep, IsComposedAcrossAFrameThatWasSkipped) {
  const auto step = stepAlong(messagesOf({message(1, 0), message(2, 1), message(3, 2)}), at(0), at(3));
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->ground.isApprox(shift(6, 3), 1e-12));
  EXPECT_TRUE(step->front->isApprox(shift(15, 0), 1e-12));
  EXPECT_TRUE(step->motion->t_ba.isApprox(Eigen::Vector3d(3, 0, 0), 1e-12));
  // Two frames back: along the ground by (4, 2), along the front plane by (10, 0).
  expectPoint(step->tracks.previous[0], 6, 8);
  expectPoint(step->tracks.previous[1], 90, 50);
  expectPoint(step->tracks.previous[2], 56, 58);
  expectPoint(step->tracks.current[2], 62, 64);
}

TEST(FrameStep, TakesTracksThatStartWhereItDoes) {
  fused_homography_t bridged = message(1, 1);  // by the IMU: vision has skipped the frame
  bridged.has_front = 0;
  bridged.tracks = {};
  const auto step = stepAlong(messagesOf({bridged, message(2, 0)}), at(0), at(2));
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->ground.isApprox(shift(4, 2), 1e-12));
  EXPECT_EQ(step->front.value(), shift(10, 0));
  expectPoint(step->tracks.previous[1], 100, 50);
  expectPoint(step->tracks.current[1], 110, 50);
}

TEST(FrameStep, IsUnknownWhereAStepIs) {
  fused_homography_t none = message(2, 1);
  none.source = fused_homography_t::NONE;
  EXPECT_FALSE(stepAlong(messagesOf({message(1, 0), none, message(3, 2)}), at(0), at(3)));
  EXPECT_FALSE(stepAlong(messagesOf({message(1, 0), message(3, 2)}), at(0), at(3)));
  EXPECT_FALSE(stepAlong(messagesOf({message(1, 0)}), at(0), at(2)));
  fused_homography_t without_front = message(1, 0);
  without_front.has_front = 0;
  const auto step = stepAlong(messagesOf({without_front, message(2, 1)}), at(0), at(2));
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->front) << "known for one of two steps";
}

}  // namespace
}  // namespace redbee::test
