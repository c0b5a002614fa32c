// redbee-geolocation on messages: what it publishes, and what its health says where something is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "processes/geolocation/node.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/gimbal_t.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

constexpr int64_t kStart_us = 1'000'000'000;
constexpr int64_t kShift_us = 20'000;
const double kKept_s = GeolocationParameters().keep_stopped_s;

class GeolocationNodeTest : public testing::Test {
 protected:
  void begin(const Configuration& configuration = TargetFlight::configuration()) {
    node_ = std::make_unique<GeolocationNode>(*bus_, configuration);
    subscription_ =
        bus_->subscribe<targets_t>("TARGETS", 1000, [this](const targets_t& m) { targets_.push_back(m); });
  }
  void settle() {
    do {
      while (bus_->handle(std::chrono::milliseconds(0))) {
      }
    } while (node_->processNext());
    while (bus_->handle(std::chrono::milliseconds(0))) {
    }
  }
  static int64_t utimeOf(double t) { return kStart_us + std::llround(t * 1e6); }
  /// Frames of [from, to) seconds, each with the pose of its time.
  void fly(double from, double to, bool has_pose = true, bool has_global = true) {
    for (int k = static_cast<int>(std::lround(from * TargetFlight::kRate_hz));
         k < to * TargetFlight::kRate_hz; ++k) {
      const double t = k / TargetFlight::kRate_hz;
      bus_->publish("DETECTIONS", TargetFlight{}.detections(utimeOf(t), t, k));
      if (has_pose) {
        bus_->publish("POSE", TargetFlight::pose(utimeOf(t) + kShift_us, t, has_global));
        bus_->publish("ALTIMETER", TargetFlight::altimeter(utimeOf(t) + kShift_us));
      }
      settle();
    }
  }
  process_health_t health() { return node_->health().nextMessage(); }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::unique_ptr<GeolocationNode> node_;
  Subscription subscription_;
  std::vector<targets_t> targets_;
};

TEST_F(GeolocationNodeTest, PlacesTheWalkerOnWgs84AndKeepsWhereItStopped) {
  begin();
  fly(0, 9);
  ASSERT_EQ(targets_.size(), 216U);
  const targets_t moving = targets_.back();
  ASSERT_EQ(moving.n, 1);
  EXPECT_EQ(moving.status, targets_t::GOOD);
  EXPECT_EQ(moving.has_global, 1);
  EXPECT_EQ(moving.targets[0].id, TargetFlight::kId);
  EXPECT_EQ(moving.targets[0].state, target_t::MOVING);
  const double t = 215 / TargetFlight::kRate_hz;
  EXPECT_LT(TargetFlight{}.missOf(moving.targets[0].latitude, moving.targets[0].longitude, t), 0.15);
  EXPECT_NEAR(moving.targets[0].velocity[0], 3.5, 0.2);
  EXPECT_NEAR(moving.targets[0].velocity[1], 0, 0.2);
  EXPECT_NEAR(moving.ground_altitude, TargetFlight::kHomeAltitude, 1e-6);
  EXPECT_NEAR(moving.camera_height, TargetFlight::kHeight_m, 1e-6);
  EXPECT_EQ(moving.has_footprint, 1);
  EXPECT_EQ(health().state, process_health_t::GOOD);
  fly(9, 20);
  const targets_t stopped = targets_.back();
  ASSERT_EQ(stopped.n, 1);
  EXPECT_EQ(stopped.targets[0].state, target_t::STOPPED);
  EXPECT_LT(TargetFlight{}.missOf(stopped.targets[0].latitude, stopped.targets[0].longitude, 20), 1.2)
      << "within what it went in a third of a second";
  for (const targets_t& m : targets_) EXPECT_EQ(faultOf(m), nullptr);
}

TEST_F(GeolocationNodeTest, WhoHasStoppedIsThereAfterARestart) {
  const ScratchFolder folder;
  begin();
  node_->keepStateIn(folder.path());
  fly(0, 20);
  ASSERT_EQ(targets_.back().n, 1);
  const target_t before = targets_.back().targets[0];
  ASSERT_EQ(before.state, target_t::STOPPED);
  begin();  // another process, whose metres begin elsewhere
  node_->keepStateIn(folder.path());
  fly(21, 23);
  ASSERT_EQ(targets_.back().n, 1);
  const target_t after = targets_.back().targets[0];
  EXPECT_EQ(after.id, before.id);
  EXPECT_EQ(after.state, target_t::STOPPED);
  EXPECT_NEAR(after.latitude, before.latitude, 1e-6);
  EXPECT_NEAR(after.longitude, before.longitude, 1e-6);
  begin();
  node_->keepStateIn(folder.path());
  fly(23 + kKept_s, 24 + kKept_s);
  EXPECT_EQ(targets_.back().n, 0) << "it was unseen for longer than it is kept";
}

TEST_F(GeolocationNodeTest, AFileOfSomethingElseRestoresNobody) {
  const ScratchFolder folder;
  for (const char* text : {"\n", "1 2 3\n", "1000000000 5 47.3 8.5 nan 0 1 1 1 50 1\n",
                           "1000000000 5 947.3 8.5 1 0 1 1 1 50 1\n"}) {
    writeText(folder / "stopped_targets", text);
    begin();
    node_->keepStateIn(folder.path());
    fly(13, 14);
    EXPECT_EQ(targets_.back().n, 0) << text;
  }
}

TEST_F(GeolocationNodeTest, WithoutAFixItCountsFromTheTakeOff) {
  begin();
  fly(0, 3, true, false);
  const targets_t message = targets_.back();
  ASSERT_EQ(message.n, 1);
  EXPECT_EQ(message.has_global, 0);
  const Eigen::Vector2d truth = TargetFlight{}.walkerPosition(71 / TargetFlight::kRate_hz);
  EXPECT_NEAR(message.targets[0].position[0], truth.x(), 0.3);
  EXPECT_NEAR(message.targets[0].position[1], truth.y(), 0.3);
}

TEST_F(GeolocationNodeTest, SaysThatNoPoseComes) {
  begin();
  fly(0, 1, false);
  ASSERT_GT(targets_.size(), 15U) << "frames are answered all the same";
  EXPECT_EQ(targets_.back().status, targets_t::NO_POSE);
  EXPECT_EQ(health().state, process_health_t::DEGRADED);
  EXPECT_THAT(health().message, HasSubstr("no POSE has come"));
}

TEST_F(GeolocationNodeTest, SaysThatThePoseIsStaleAndPredicts) {
  begin();
  fly(0, 3);
  fly(3, 4, false);
  EXPECT_EQ(targets_.back().status, targets_t::STALE_POSE);
  EXPECT_THAT(health().message, HasSubstr("s from the frame, allowed are 0.20 s"));
  ASSERT_EQ(targets_.back().n, 1);
  EXPECT_EQ(targets_.back().targets[0].state, target_t::COASTING);
  fly(4, 5);
  EXPECT_EQ(targets_.back().status, targets_t::GOOD);
  EXPECT_EQ(targets_.back().targets[0].state, target_t::MOVING);
}

TEST_F(GeolocationNodeTest, SaysThatTheDetectionsAreOfAnotherCamera) {
  Configuration small = TargetFlight::configuration();
  small.camera = {320, 200, 250, 250, 159.5, 99.5, {}};
  begin(small);
  fly(0, 1);
  EXPECT_EQ(targets_.back().status, targets_t::OTHER_CAMERA);
  EXPECT_EQ(targets_.back().n, 0);
  EXPECT_THAT(health().message, HasSubstr("DETECTIONS are of another camera"));
  EXPECT_THAT(health().message, HasSubstr("configured is an image of 320x200"));
}

TEST_F(GeolocationNodeTest, PlacesNobodyWhoseBoxOfAnotherCameraFitsNowAndThen) {
  Configuration small = TargetFlight::configuration();
  small.camera = {260, 240, 250, 250, 129.5, 119.5, {}};
  begin(small);
  fly(0, 12);
  const auto is_told = [](const targets_t& m) { return m.status == targets_t::OTHER_CAMERA; };
  const auto first = std::find_if(targets_.begin(), targets_.end(), is_told);
  ASSERT_NE(first, targets_.end());
  ASSERT_NE(first, targets_.begin()) << "his box has to fit at first";
  for (auto m = first; m != targets_.end() && m->utime < first->utime + 9'000'000; ++m) {
    EXPECT_EQ(m->status, targets_t::OTHER_CAMERA);
    EXPECT_EQ(m->n, 0);
  }
}

// Once a second: a stray sender, or one who wants nobody placed.
TEST_F(GeolocationNodeTest, AStrayMessageOfAnotherCameraBlindsNobody) {
  begin();
  constexpr int kSeconds = 9;
  for (int s = 0; s < kSeconds; ++s) {
    detections_t stray = TargetFlight{}.detections(utimeOf(s + 0.02), s + 0.02, 1000 + s);
    stray.detections[0].x += 2000;
    bus_->publish("DETECTIONS", stray);
    fly(s, s + 1);
  }
  ASSERT_EQ(targets_.size(), kSeconds * TargetFlight::kRate_hz) << "only frames of this camera are answered";
  for (const targets_t& m : targets_) EXPECT_EQ(m.status, targets_t::GOOD);
  EXPECT_EQ(targets_.back().n, 1);
  EXPECT_EQ(health().damaged, kSeconds);
  for (int k = 0; k < 80; ++k) {  // one that seldom sees anything
    detections_t other = TargetFlight{}.detections(utimeOf(kSeconds + k / 24.0), kSeconds, 2000 + k);
    other.detections[0].x += 2000;
    if (k % 10 != 0) other.detections.resize(static_cast<size_t>(other.n = 0));
    bus_->publish("DETECTIONS", other);
  }
  fly(kSeconds + 4, kSeconds + 5);
  EXPECT_EQ(targets_.back().status, targets_t::OTHER_CAMERA);
}

TEST_F(GeolocationNodeTest, SaysThatTheLensIsNotTheConfiguredOne) {
  begin();
  fly(0, 1);
  lens_t lens{};
  lens.utime = utimeOf(1);
  lens.has_focal_length = 1;
  lens.width = 1280;
  lens.focal_length = 2000;  // twice the configured 500 px of 640
  bus_->publish("LENS", lens);
  fly(1, 2);
  EXPECT_EQ(targets_.back().status, targets_t::OTHER_CAMERA);
  EXPECT_THAT(health().message, HasSubstr("LENS says a focal length of 1000 px, configured are 500 px"));
}

TEST_F(GeolocationNodeTest, SaysThatTheGimbalIsSilent) {
  Configuration configuration = TargetFlight::configuration();
  configuration.geolocation.mount = "gimbal";
  begin(configuration);
  fly(0, 1);
  EXPECT_EQ(targets_.back().status, targets_t::NO_MOUNT);
  EXPECT_THAT(health().message, HasSubstr("no GIMBAL near the frame"));
}

TEST_F(GeolocationNodeTest, AFrameWithoutATrustedMaskStopsNobody) {
  begin();
  fly(0, 3);
  for (int k = 72; k < 144; ++k) {
    const double t = k / TargetFlight::kRate_hz;
    detections_t blind{};
    blind.utime = utimeOf(t);
    blind.sequence = k;
    blind.status = foreground_t::NO_HOMOGRAPHY;
    bus_->publish("DETECTIONS", blind);
    bus_->publish("POSE", TargetFlight::pose(utimeOf(t) + kShift_us, t));
    settle();
  }
  ASSERT_EQ(targets_.back().n, 1);
  EXPECT_EQ(targets_.back().targets[0].state, target_t::COASTING);
}

TEST(GeolocationNode, NeedsToBeEnabled) {
  Configuration configuration = TargetFlight::configuration();
  configuration.geolocation.enabled = false;
  const auto bus = makeLcmBus("memq://");
  EXPECT_THROW(GeolocationNode(*bus, configuration), UserError);
}

}  // namespace
}  // namespace redbee::test
