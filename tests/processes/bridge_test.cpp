// A frame that no homography reaches, and one that connects the frames before and after it but comes late.
#include <gtest/gtest.h>

#include <algorithm>

#include "processes/conversions.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

/// The segmentation alone, between true messages of vision and the fusion.
class Bridge : public testing::Test {
 protected:
  static constexpr int kUnseen = 20;  ///< the frame that vision missed, and the IMU knows too little about

  Bridge() : bus_(makeLcmBus("memq://")), node_(*bus_, undisturbedFlight().configuration) {
    subscription_ = bus_->subscribe<foreground_t>(
        "FOREGROUND", 64, [this](const foreground_t& m) { status_[m.utime] = m.status; });
    for (int k = 0; k < kUnseen; ++k) {
      sendFused(k, k == 0 ? fused_homography_t::NONE : fused_homography_t::FUSED);
      sendImage(k);
    }
    EXPECT_EQ(statusOf(kUnseen - 1), foreground_t::GOOD);
    sendFused(kUnseen, fused_homography_t::NONE);
    sendVisual(kUnseen, kUnseen - 1, visual_homography_t::NO_IMAGE);
    sendImage(kUnseen);
  }

  static int64_t utimeOf(int k) { return undisturbedFlight().frame_utimes[static_cast<size_t>(k)]; }
  /// foreground_t's, or -1: not answered yet.
  int statusOf(int k) const {
    const auto found = status_.find(utimeOf(k));
    return found == status_.end() ? -1 : found->second;
  }

  void sendImage(int k) {
    for (const SensorMessage& sent : undisturbedFlight().messages) {
      if (sent.channel == "CAMERA" && sent.utime == utimeOf(k)) bus_->publish(sent.channel, sent.data);
    }
    settle();
  }
  void sendFused(int k, int8_t source) {
    fused_homography_t m{};
    m.utime = utimeOf(k);
    m.utime_previous = m.utime_tracks = utimeOf(std::max(0, k - 1));
    m.sequence = k;
    m.source = source;
    m.epoch = k;
    m.utime_anchor = source == fused_homography_t::NONE ? m.utime : m.utime_previous;
    const Eigen::Matrix3d H = k == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : homography(k - 1, k);
    fill(m.step, H, kCovariance);
    fill(m.anchor, H, kCovariance);
    const CameraIntrinsics& camera = undisturbedFlight().configuration.camera;
    m.width = camera.width;
    m.height = camera.height;
    bus_->publish("FUSED_HOMOGRAPHY", m);
    settle();
  }
  void sendVisual(int k, int from, int8_t status) {
    visual_homography_t m{};
    m.utime = utimeOf(k);
    m.utime_previous = utimeOf(from);
    m.sequence = visual_sequence_++;
    m.status = status;
    m.inliers = 100;
    const CameraIntrinsics& camera = undisturbedFlight().configuration.camera;
    m.width = camera.width;
    m.height = camera.height;
    fill(m.ground, homography(from, k), kCovariance);
    bus_->publish("VISUAL_HOMOGRAPHY", m);
    settle();
  }

 private:
  inline static const Matrix8d kCovariance = 1e-8 * Matrix8d::Identity();

  static Eigen::Matrix3d homography(int from, int to) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
    for (int k = from + 1; k <= to; ++k) H = undisturbedFlight().homographies[static_cast<size_t>(k)] * H;
    return normaliseHomography(H);
  }
  void settle() {
    while (bus_->handle(std::chrono::milliseconds(0)) > 0) {
    }
    node_.process();
    while (bus_->handle(std::chrono::milliseconds(0)) > 0) {
    }
  }

  std::unique_ptr<Bus> bus_;
  MotionSegmentationNode node_;
  Subscription subscription_;
  std::map<int64_t, int8_t> status_;
  int32_t visual_sequence_ = 0;
};

TEST_F(Bridge, IsWaitedForAndTheBackgroundGoesOn) {
  EXPECT_EQ(statusOf(kUnseen), -1) << "what connects the next frame may still come";
  sendFused(kUnseen + 1, fused_homography_t::NONE);
  sendImage(kUnseen + 1);
  EXPECT_EQ(statusOf(kUnseen), -1);
  sendVisual(kUnseen + 1, kUnseen - 1, visual_homography_t::GOOD);
  EXPECT_EQ(statusOf(kUnseen), foreground_t::NO_HOMOGRAPHY);
  EXPECT_EQ(statusOf(kUnseen + 1), foreground_t::GOOD);
}

TEST_F(Bridge, IsWaitedForNoLongerThanForAHomography) {
  const double wait_s = undisturbedFlight().configuration.waits.segmentation_s;
  int k = kUnseen;
  while (utimeOf(k) - utimeOf(kUnseen) <= 1e6 * wait_s) {
    EXPECT_EQ(statusOf(kUnseen), -1);
    sendImage(++k);
  }
  EXPECT_EQ(statusOf(kUnseen), foreground_t::NO_HOMOGRAPHY);
}

TEST_F(Bridge, IsNotWaitedForWhereVisionGoesOnFromTheFrame) {
  sendVisual(kUnseen + 1, kUnseen - 1, visual_homography_t::GOOD);
  ASSERT_EQ(statusOf(kUnseen), foreground_t::NO_HOMOGRAPHY);
  sendFused(kUnseen + 1, fused_homography_t::NONE);
  sendImage(kUnseen + 1);
  for (int k = kUnseen + 2; k < kUnseen + 4; ++k) {
    sendFused(k, fused_homography_t::NONE);
    sendVisual(k, k - 1, visual_homography_t::NO_PLANE);
    sendImage(k);
    EXPECT_EQ(statusOf(k), foreground_t::NO_HOMOGRAPHY);
  }
}

}  // namespace
}  // namespace redbee::test
