#include "redbee/mavlink/vehicle_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/mavlink/axes.hpp"
#include "tests/mavlink/attitudes.hpp"

namespace redbee::mavlink {
namespace {

TEST(MavlinkAxes, HeadingEastForwardIsEastAndLeftIsNorth) {
  const Quaterniond R = enuRotation(attitude(90));
  expectNear(R * Vector3d::UnitX(), {1, 0, 0});
  expectNear(R * Vector3d::UnitY(), {0, 1, 0});
  expectNear(R * Vector3d::UnitZ(), {0, 0, 1});
}

TEST(MavlinkAxes, NoseUpPointsUpAndRollToTheRightLowersTheRightWing) {
  expectNear(enuRotation(attitude(0, 30)) * Vector3d::UnitX(), {0, std::cos(30 * kDeg), std::sin(30 * kDeg)});
  // The right wing is -y of FLU.
  EXPECT_LT((enuRotation(attitude(0, 0, 20)) * -Vector3d::UnitY()).z(), -0.3);
}

TEST(MavlinkAxes, AVectorTurnsAlike) {
  const Quaterniond q = attitude(37, -12, 25);
  const Vector3d frd(0.3, -0.7, 1.1);
  expectNear(enuRotation(q) * fluOf(frd), enuOf(q * frd), 1e-12);
  const Quaterniond p = attitude(-80, 40, 10);
  expectNear(fluRotation(p) * fluOf(frd), fluOf(p * frd), 1e-12);
}

TEST(MavlinkImu, AtRestAndLevelTheSpecificForceIsUp) {
  HighresImu m;
  m.zacc = -9.81F;
  m.zgyro = 0.5F;  // to the right, seen from above
  m.fields_updated = 0x3f;
  const auto reading = readingOf(m, kNow);
  ASSERT_TRUE(reading);
  expectNear(reading->accel, {0, 0, 9.81});
  expectNear(reading->gyro, {0, 0, -0.5});
}

TEST(MavlinkImu, UnitsAreThoseOfTheField) {
  RawImu raw;
  raw.time_usec = 5;
  raw.zacc = -1000;  // mG
  raw.xgyro = 250;   // mrad/s
  const auto reading = readingOf(raw, kNow);
  ASSERT_TRUE(reading);
  expectNear(reading->accel, {0, 0, 9.80665});
  expectNear(reading->gyro, {0.25, 0, 0});
  ScaledImu2 scaled;
  scaled.time_boot_ms = 7;
  scaled.yacc = 500;
  EXPECT_EQ(readingOf(scaled, kNow)->device_us, 7000);
  expectNear(readingOf(scaled, kNow)->accel, {0, -4.903325, 0});
}

TEST(MavlinkImu, RefusesWhatIsNoNewSample) {
  HighresImu m;
  m.zacc = -9.81F;
  m.fields_updated = 0x38;
  EXPECT_FALSE(readingOf(m, kNow)) << "gyro only";
  m.fields_updated = 0x3f;
  m.id = 1;
  EXPECT_FALSE(readingOf(m, kNow)) << "a second IMU";
  m.id = 0;
  m.xgyro = kNan;
  EXPECT_FALSE(readingOf(m, kNow));
  EXPECT_FALSE(readingOf(ScaledImu2{}, kNow)) << "no sensor";
}

TEST(MavlinkPose, IsCarriedOnFromTheLastPosition) {
  VehicleState state({});
  GpsRawInt gps;
  gps.fix_type = 3;
  gps.h_acc = 1500;
  gps.v_acc = 3000;
  gps.vel_acc = 400;
  gps.alt = 500'000;
  gps.alt_ellipsoid = 547'000;
  state.note(gps, kNow);
  GlobalPositionInt global;
  global.lat = 473'000'000;
  global.lon = 85'000'000;
  global.alt = 510'000;
  global.relative_alt = 10'000;
  global.vx = 1000;  // north, cm/s
  global.vz = -200;
  state.note(global, kNow - fromSeconds(0.5));
  const auto pose = state.poseAt(messageOf(attitude(0)), kNow);
  ASSERT_TRUE(pose && pose->global && pose->velocity);
  expectNear(*pose->velocity, {0, 10, 2});
  // Five metres north are 5 / R of a radian.
  EXPECT_NEAR(pose->global->latitude_deg, 47.3 + 5 / 6'371'000.0 / kDeg, 1e-9);
  EXPECT_NEAR(pose->global->longitude_deg, 8.5, 1e-9);
  EXPECT_NEAR(pose->global->altitude_m, 511, 1e-9);
  EXPECT_NEAR(*pose->global->ellipsoid_altitude_m, 558, 1e-9);
  EXPECT_NEAR(pose->global->home_altitude_m, 11, 1e-9);
  EXPECT_NEAR(pose->global->covariance(0, 0), 1.5 * 1.5 + 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(pose->global->covariance(2, 2), 3.0 * 3.0 + 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(pose->velocity_covariance(1, 1), 0.16, 1e-9);
}

TEST(MavlinkPose, WithoutAFixThereIsNoGlobalPosition) {
  VehicleState state({});
  state.note(GlobalPositionInt{}, kNow);
  EXPECT_FALSE(state.poseAt(messageOf(attitude(0)), kNow)->global);
  LocalPositionNed local;
  local.x = 3;
  local.z = -2;
  local.vy = 1;
  state.note(local, kNow - fromSeconds(0.1));
  const auto pose = state.poseAt(messageOf(attitude(0)), kNow);
  expectNear(*pose->local, {0.1, 3, 2});
  expectNear(*pose->velocity, {1, 0, 0});
  EXPECT_FALSE(state.poseAt(messageOf(attitude(0)), kNow + fromSeconds(2))->velocity) << "old";
}

TEST(MavlinkPose, AnAttitudeHasALengthOfOne) {
  VehicleState state({});
  EXPECT_FALSE(state.poseAt(messageOf(Quaterniond(0.5, 0, 0, 0)), kNow));
  EXPECT_FALSE(state.poseAt(messageOf(Quaterniond(kNan, 0, 0, 0)), kNow));
}

DistanceSensor rangeOf(uint16_t distance_cm) {
  DistanceSensor m;
  m.min_distance = 20;
  m.max_distance = 4000;
  m.current_distance = distance_cm;
  m.orientation = DistanceSensor::kDownward;
  return m;
}

TEST(MavlinkHeight, IsTheVerticalPartOfTheDistance) {
  AutopilotParameters parameters;
  parameters.rangefinder_above_camera_m = 0.1;
  VehicleState state(parameters);
  EXPECT_FALSE(state.heightOf(rangeOf(1000), kNow)) << "no attitude";
  state.poseAt(messageOf(attitude(70, 0, 20)), kNow);
  const auto height = state.heightOf(rangeOf(1000), kNow);
  ASSERT_TRUE(height);
  EXPECT_NEAR(height->height_m, 9.9 * std::cos(20 * kDeg), 1e-6);
  const double tilt = 10 * std::sin(20 * kDeg) * kDeg;
  EXPECT_NEAR(height->sigma_m, std::hypot(0.2, tilt), 1e-6);
  state.poseAt(messageOf(attitude(0, 40)), kNow);
  EXPECT_FALSE(state.heightOf(rangeOf(1000), kNow)) << "too steep";
}

TEST(MavlinkHeight, OnlyAReadingWithinRangeOfASensorThatFacesDown) {
  VehicleState state({});
  state.poseAt(messageOf(attitude(0)), kNow);
  EXPECT_TRUE(state.heightOf(rangeOf(20), kNow));
  EXPECT_FALSE(state.heightOf(rangeOf(19), kNow));
  EXPECT_FALSE(state.heightOf(rangeOf(4001), kNow));
  DistanceSensor forward = rangeOf(500);
  forward.orientation = 0;
  EXPECT_FALSE(state.heightOf(forward, kNow));
  DistanceSensor invalid = rangeOf(500);
  invalid.signal_quality = 1;
  EXPECT_FALSE(state.heightOf(invalid, kNow));
}

}  // namespace
}  // namespace redbee::mavlink
