// The camera's conversation with a ground station, on simulated clocks.
#include "redbee/mavlink/tracking_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace redbee::mavlink {
namespace {

using namespace tracking_status;
constexpr int64_t kMs = 1'000'000;

class TrackingCameraTest : public testing::Test {
 protected:
  TrackingCameraTest() { show({object(1, 0.1, 0.1), object(2, 0.5, 0.5)}); }

  static TrackedObject object(int id, double left, double top, bool seen = true) {
    TrackedObject object;
    object.id = id;
    object.is_seen = seen;
    object.box = RelativeBox{left, top, left + 0.1 * id, top + 0.1};
    object.place = ObjectPlace{47.3, 8.5, 500, 2, 3, 4, 0.5, 60};
    return object;
  }
  void show(const std::vector<TrackedObject>& objects) { camera_.show(objects, now_ns_); }
  /// Sends a command and returns its result; 255: no answer.
  int command(uint16_t id, std::array<float, 7> param, uint8_t component = 100, uint8_t system = 1) {
    return answerTo(station_.encode(CommandLong{param, id, system, component, 0}));
  }
  int answerTo(const Bytes& frame) {
    camera_.receive(frame.data(), frame.size(), now_ns_, true);
    int result = 255;
    for (const Frame& each : take()) {
      if (each.id == CommandAck::kId) result = each.message<CommandAck>().result;
    }
    return result;
  }
  std::vector<Frame> take() {
    std::vector<Frame> frames;
    for (const Bytes& bytes : camera_.dueFrames(now_ns_)) parser_.feed(bytes.data(), bytes.size());
    while (const auto frame = parser_.next()) frames.push_back(*frame);
    return frames;
  }
  template <typename Message>
  std::vector<Message> pass(int64_t ms, bool shows = true) {
    std::vector<Message> messages;
    for (int64_t i = 0; i < ms; i += 50) {
      now_ns_ += 50 * kMs;
      if (shows) show(shown_);
      for (const Frame& frame : take()) {
        if (frame.id == Message::kId) messages.push_back(frame.message<Message>());
      }
    }
    return messages;
  }

  int64_t now_ns_ = 100'000 * kMs;
  GroundLinkParameters parameters_;
  TrackingCamera camera_{parameters_, 640, 480, std::nullopt, 0};
  Encoder station_{255, 190};
  Parser parser_;
  std::vector<TrackedObject> shown_{object(1, 0.1, 0.1), object(2, 0.5, 0.5, false)};
};

TEST_F(TrackingCameraTest, IndicatesMoversWhileNobodyIsPicked) {
  const auto status = pass<CameraTrackingImageStatus>(1000);
  ASSERT_EQ(status.size(), 10U);                           // two movers, five times a second
  EXPECT_EQ(status[0].tracking_status, kMti | kCoasting);  // the larger one first, which is not seen
  EXPECT_EQ(status[1].tracking_status, kMti);
  EXPECT_EQ(status[1].tracking_mode, CameraTrackingImageStatus::kRectangleMode);
  EXPECT_FLOAT_EQ(status[1].rec_top_x, 0.1F);
  EXPECT_FLOAT_EQ(status[1].rec_bottom_x, 0.2F);
  EXPECT_EQ(pass<CameraTrackingGeoStatus>(1000).size(), 10U);
}

TEST_F(TrackingCameraTest, APointPicksTheObjectThere) {
  EXPECT_EQ(command(camera_command::kTrackPoint, {0.15F, 0.15F, 0}), command_result::kAccepted);
  EXPECT_EQ(camera_.picked(), 1);
  const auto status = pass<CameraTrackingImageStatus>(1000);
  ASSERT_EQ(status.size(), 5U);
  EXPECT_EQ(status[0].tracking_status, kActive | kMti);
  EXPECT_EQ(status[0].tracking_mode, CameraTrackingImageStatus::kPointMode);
  EXPECT_FLOAT_EQ(status[0].point_x, 0.15F);
  EXPECT_FLOAT_EQ(status[0].radius, 0.05F);
  const auto geo = pass<CameraTrackingGeoStatus>(1000);
  ASSERT_EQ(geo.size(), 5U);
  EXPECT_EQ(geo[0].tracking_status, kActive | kMti);
  EXPECT_EQ(geo[0].lat, 473'000'000);
  EXPECT_EQ(geo[0].lon, 85'000'000);
  EXPECT_FLOAT_EQ(geo[0].vel_n, 3);
  EXPECT_FLOAT_EQ(geo[0].vel_e, 4);
  EXPECT_FLOAT_EQ(geo[0].hdg, std::atan2(4.F, 3.F));
  EXPECT_FLOAT_EQ(geo[0].hdg_acc, 0.1F);
}

TEST_F(TrackingCameraTest, ARectanglePicksTheObjectThatFillsIt) {
  EXPECT_EQ(command(camera_command::kTrackRectangle, {0.45F, 0.45F, 0.75F, 0.65F}),
            command_result::kAccepted);
  EXPECT_EQ(camera_.picked(), 2);
  const auto status = pass<CameraTrackingImageStatus>(200);
  ASSERT_FALSE(status.empty());
  EXPECT_EQ(status[0].tracking_status, kActive | kMti | kCoasting);
  EXPECT_EQ(command(camera_command::kStopTracking, {}), command_result::kAccepted);
  EXPECT_FALSE(camera_.picked());
}

TEST_F(TrackingCameraTest, RefusesWhatPicksNobody) {
  EXPECT_EQ(command(camera_command::kTrackPoint, {0.9F, 0.9F, 0}), command_result::kFailed);
  EXPECT_EQ(command(camera_command::kTrackPoint, {1.5F, 0.9F, 0}), command_result::kDenied);
  EXPECT_EQ(command(camera_command::kTrackPoint, {std::nanf(""), 0.9F, 0}), command_result::kDenied);
  EXPECT_EQ(command(camera_command::kTrackRectangle, {0.8F, 0.8F, 0.7F, 0.9F}), command_result::kDenied);
  EXPECT_EQ(command(camera_command::kTrackRectangle, {0.8F, 0.8F, 0.9F, 0.9F}), command_result::kFailed);
  EXPECT_EQ(command(2000, {}), command_result::kUnsupported);
  EXPECT_EQ(command(2000, {}, 0), 255) << "for all components: others answer";
  EXPECT_EQ(command(camera_command::kStopTracking, {}, 100, 2), 255) << "another vehicle's";
  EXPECT_EQ(command(camera_command::kStopTracking, {}, 1), 255) << "another component's";
  EXPECT_FALSE(camera_.picked());
}

TEST_F(TrackingCameraTest, WhoIsPickedAndLostIsCoastedThenGivenUp) {
  command(camera_command::kTrackPoint, {0.15F, 0.15F, 0});
  shown_ = {object(2, 0.5, 0.5)};
  const auto coasting = pass<CameraTrackingImageStatus>(2000);
  EXPECT_EQ(coasting.back().tracking_status, kActive | kCoasting);
  EXPECT_TRUE(std::isnan(coasting.back().point_x));
  EXPECT_EQ(coasting.back().target_data, 0);
  const auto after = pass<CameraTrackingImageStatus>(2000);
  EXPECT_EQ(after.back().tracking_status, kMti);
  EXPECT_FALSE(camera_.picked());
}

TEST_F(TrackingCameraTest, WithoutNewFramesItSaysSo) {
  command(camera_command::kTrackPoint, {0.15F, 0.15F, 0});
  EXPECT_EQ(pass<CameraTrackingImageStatus>(2000, false).back().tracking_status, kError);
  EXPECT_EQ(command(camera_command::kTrackPoint, {0.15F, 0.15F, 0}), command_result::kFailed);
  command(camera_command::kStopTracking, {});
  EXPECT_EQ(pass<CameraTrackingImageStatus>(500, false).back().tracking_status, kIdle);
}

TEST_F(TrackingCameraTest, StatesItsCapabilitiesAndRates) {
  const Bytes request = station_.encode(CommandLong{{259}, camera_command::kRequestMessage, 1, 100, 0});
  camera_.receive(request.data(), request.size(), now_ns_, true);
  uint32_t flags = 0;
  for (const Frame& frame : take()) {
    if (frame.id != CameraInformation::kId) continue;
    const auto message = frame.message<CameraInformation>();
    flags = message.flags;
    EXPECT_EQ(message.resolution_h, 640);
    EXPECT_TRUE(std::isnan(message.focal_length));
  }
  EXPECT_EQ(flags, 512U | 1024U | 2048U | 8192U);
  EXPECT_EQ(command(camera_command::kSetMessageInterval, {276, -1}), command_result::kAccepted);
  EXPECT_TRUE(pass<CameraTrackingGeoStatus>(1000).empty());
  EXPECT_EQ(command(camera_command::kSetMessageInterval, {275, 100'000}), command_result::kAccepted);
  EXPECT_EQ(pass<CameraTrackingImageStatus>(1000).size(), 20U);
  EXPECT_EQ(command(camera_command::kSetMessageInterval, {275, 10}), command_result::kDenied);
  EXPECT_EQ(command(camera_command::kSetMessageInterval, {30, 100'000}), command_result::kUnsupported);
  EXPECT_EQ(command(camera_command::kStopMti, {}), command_result::kAccepted);
  EXPECT_EQ(pass<CameraTrackingImageStatus>(500).back().tracking_status, kIdle);
}

TEST_F(TrackingCameraTest, WithAKeyOnlySignedCommandsCount) {
  const SigningKey key{1, 2, 3};
  TrackingCamera camera(parameters_, 640, 480, key, 1'000'000);
  camera.show(shown_, now_ns_);
  const CommandLong point{{0.15F, 0.15F, 0}, camera_command::kTrackPoint, 1, 100, 0};
  const Bytes plain = station_.encode(point);
  camera.receive(plain.data(), plain.size(), now_ns_, true);
  EXPECT_FALSE(camera.picked());
  EXPECT_EQ(camera.trust().unsignedFrames(), 1);
  station_.signWith(Signer(key, 0, 2'000'000));
  const Bytes with_signature = station_.encode(point);
  camera.receive(with_signature.data(), with_signature.size(), now_ns_, true);
  EXPECT_EQ(camera.picked(), 1);
}

TEST_F(TrackingCameraTest, ObeysCommandIntLikeCommandLong) {
  CommandInt point;
  point.param = {0.15F, 0.15F, 0, 0};
  point.command = camera_command::kTrackPoint;
  point.target_system = 1;
  point.target_component = 100;
  EXPECT_EQ(answerTo(station_.encode(point)), command_result::kAccepted);
  const auto status = pass<CameraTrackingImageStatus>(400);
  ASSERT_FALSE(status.empty());
  EXPECT_EQ(status.back().tracking_status & kActive, kActive);
  point.param = {2, 2, 0, 0};
  EXPECT_EQ(answerTo(station_.encode(point)), command_result::kDenied);
  point.target_system = 2;
  EXPECT_EQ(answerTo(station_.encode(point)), 255) << "of another vehicle";
}

}  // namespace
}  // namespace redbee::mavlink
