#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

#include "redbee/mavlink/axes.hpp"
#include "redbee/mavlink/session.hpp"
#include "redbee/mavlink/vehicle_state.hpp"
#include "tests/mavlink/attitudes.hpp"

namespace redbee::mavlink {
namespace {

constexpr uint8_t kCamera = 100;  // component

/// A gimbal that looks 60 degrees down and 30 to the right of the nose, under a body that pitches and rolls.
TEST(MavlinkGimbal, EveryFrameGivesTheSameMount) {
  const Quaterniond body = attitude(110, 8, -5);
  const Quaterniond mount = attitude(30, -60);
  const Quaterniond in_ned = body * mount;
  const Quaterniond level = Quaterniond(AngleAxisd(-110 * kDeg, Vector3d::UnitZ())) * in_ned;
  VehicleState state({});
  state.poseAt(messageOf(body), kNow);
  const auto fill = [](const Quaterniond& q, uint16_t flags, float delta_yaw) {
    GimbalDeviceAttitudeStatus m;
    m.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
           static_cast<float>(q.z())};
    m.flags = flags;
    m.delta_yaw = delta_yaw;
    return m;
  };
  using Status = GimbalDeviceAttitudeStatus;
  const auto turn = static_cast<float>(110 * kDeg);
  const GimbalDeviceAttitudeStatus forms[] = {
      fill(in_ned, Status::kYawInEarthFrame, kNan), fill(in_ned, Status::kYawLock, 0),
      fill(level, Status::kYawInVehicleFrame, turn), fill(level, Status::kYawInVehicleFrame, kNan),
      fill(level, 0, 0.5F)};
  for (const auto& form : forms) {
    const auto gimbal = state.gimbalOf(form, kNow);
    ASSERT_TRUE(gimbal && gimbal->body_from_gimbal && gimbal->enu_from_gimbal);
    EXPECT_LT(gimbal->body_from_gimbal->angularDistance(fluRotation(mount)), 1e-5);
    EXPECT_LT(gimbal->enu_from_gimbal->angularDistance(enuRotation(in_ned)), 1e-5);
  }
  // Sixty degrees below the body's forward-left plane.
  expectNear(fluRotation(mount) * Vector3d::UnitX(),
             {0.5 * std::cos(30 * kDeg), -0.5 * std::sin(30 * kDeg), -std::sin(60 * kDeg)});
}

/// Between two attitudes of the body it has turned on.
TEST(MavlinkGimbal, TheBodysAttitudeIsCarriedOnByItsRate) {
  const Quaterniond body = attitude(110, 8, -5);
  AttitudeQuaternion message = messageOf(body);
  message.rollspeed = 1.2F;
  VehicleState state({});
  state.poseAt(message, kNow);
  GimbalDeviceAttitudeStatus level;  // looks north, whatever the body does
  level.q = {1, 0, 0, 0};
  level.flags = GimbalDeviceAttitudeStatus::kYawInEarthFrame;
  const auto gimbal = state.gimbalOf(level, kNow + std::chrono::milliseconds(20));
  ASSERT_TRUE(gimbal && gimbal->body_from_gimbal);
  const Quaterniond turned = body * Quaterniond(AngleAxisd(0.024, Vector3d::UnitX()));
  EXPECT_LT(gimbal->body_from_gimbal->angularDistance(fluRotation(turned.conjugate())), 1e-5);
}

TEST(MavlinkGimbal, AMountSaysAnglesAgainstTheHorizon) {
  const Quaterniond body = attitude(45, 10, 20);
  VehicleState state({});
  EXPECT_FALSE(state.gimbalOf(MountOrientation{}, kNow)) << "no heading";
  state.poseAt(messageOf(body), kNow);
  MountOrientation m;
  m.pitch = -90;
  const auto gimbal = state.gimbalOf(m, kNow);
  ASSERT_TRUE(gimbal);
  expectNear(*gimbal->enu_from_gimbal * Vector3d::UnitX(), {0, 0, -1}, 1e-5);
  m.yaw = kNan;
  EXPECT_FALSE(state.gimbalOf(m, kNow));
}

TEST(MavlinkLens, FocalLengthIsKnownAtTheWideEnd) {
  VehicleState state({});
  CameraInformation camera;
  camera.focal_length = 4;
  camera.sensor_size_h = 6;
  camera.resolution_h = 3000;
  state.note(camera);
  CameraSettings settings;
  settings.zoom_level = kNan;
  EXPECT_NEAR(state.lensOf(settings, kNow).focal_px.value(), 2000, 1e-9);
  EXPECT_FALSE(state.lensOf(settings, kNow).zoom);
  settings.zoom_level = 25;
  EXPECT_NEAR(state.lensOf(settings, kNow).zoom.value(), 0.25, 1e-9);
  EXPECT_FALSE(state.lensOf(settings, kNow).focal_px);
}

TEST(MavlinkLens, TheFieldOfViewGivesTheFocalLength) {
  CameraFovStatus status;
  status.hfov = 90;
  const auto wide = VehicleState::lensOf(status, kNow);
  ASSERT_TRUE(wide && wide->focal_px);
  EXPECT_NEAR(*wide->focal_px / wide->width_px, 0.5, 1e-9);
  EXPECT_FALSE(wide->zoom);
  status.hfov = static_cast<float>(2 * std::atan(0.25) / kDeg);
  EXPECT_NEAR(*VehicleState::lensOf(status, kNow)->focal_px / *wide->focal_px, 4.0, 1e-6);
  for (const float unknown : {kNan, 0.0F, -3.0F, 180.0F}) {
    status.hfov = unknown;
    EXPECT_FALSE(VehicleState::lensOf(status, kNow)) << unknown;
  }
}

/// Two numbers for one focal length would have the zoom leap to and fro.
TEST(MavlinkLens, TheFieldOfViewCountsWhereBothAreSaid) {
  Session session({}, std::nullopt, SigningTime{});
  Encoder camera(1, kCamera);
  const auto lensesOf = [&](const auto& message, int64_t now_ns) {
    const Bytes frame = camera.encode(message);
    return session.receive(frame.data(), frame.size(), now_ns, true).size();
  };
  CameraSettings settings;
  settings.zoom_level = 10;
  CameraFovStatus status;
  status.hfov = kNan;
  EXPECT_EQ(lensesOf(status, 1'000'000'000), 0U);
  EXPECT_EQ(lensesOf(settings, 1'100'000'000), 1U) << "what has not said it yet does not count";
  status.hfov = 60;
  EXPECT_EQ(lensesOf(status, 1'200'000'000), 1U);
  EXPECT_EQ(lensesOf(settings, 1'300'000'000), 0U);
}

TEST(MavlinkLens, ACameraOfItsOwnIsAskedToo) {
  Session session({}, std::nullopt, SigningTime{});
  const auto hear = [&](uint8_t component, const Heartbeat& heartbeat) {
    const Bytes frame = Encoder(1, component).encode(heartbeat);
    session.receive(frame.data(), frame.size(), 1'000'000'000, true);
  };
  constexpr uint8_t kCameraType = 30;
  hear(Session::kAutopilotComponent, Heartbeat{0, 2, Heartbeat::kPx4, 0, 4, 3});
  hear(kCamera, Heartbeat{0, kCameraType, 8, 0, 4, 3});
  Parser parser;
  for (const Bytes& frame : session.dueFrames(1'000'000'000)) parser.feed(frame.data(), frame.size());
  std::multiset<uint8_t> asked;
  while (const auto frame = parser.next()) {
    if (frame->id != CommandLong::kId) continue;
    const auto command = frame->message<CommandLong>();
    if (command.param[0] == CameraFovStatus::kId) asked.insert(command.target_component);
  }
  EXPECT_EQ(asked, (std::multiset<uint8_t>{Session::kAutopilotComponent, kCamera}));
}

}  // namespace
}  // namespace redbee::mavlink
