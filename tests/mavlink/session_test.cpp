// The conversation with a simulated autopilot, on simulated clocks.
#include "redbee/mavlink/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "tests/mavlink/simulated_autopilot.hpp"
#include "tests/mavlink/vectors.hpp"

namespace redbee::mavlink {
namespace {

TEST(MavlinkSession, AsksForTheImuAndPutsItOnOurClock) {
  Flight flight;
  flight.run(3000);
  flight.take<ImuReading>();
  const int64_t begin = flight.now_ns;
  flight.run(1000);
  const auto readings = flight.take<ImuReading>();
  EXPECT_NEAR(static_cast<double>(readings.size()), 200, 2);
  for (size_t i = 0; i < readings.size(); ++i) {
    // Sent at whole multiples of 5 ms of our clock.
    const int64_t us = toUtime(readings[i].time);
    EXPECT_LE(std::abs(us - (us + 2500) / 5000 * 5000), 1);
    EXPECT_LE(us * 1000, begin + 1000 * kMs);
    EXPECT_LE(std::abs(readings[i].device_us - (us - flight.autopilot.boot_ns / 1000)), 1);
  }
  EXPECT_GE(flight.autopilot.heartbeats_heard, 3);
  EXPECT_EQ(flight.session.autopilotName(), "PX4");
  EXPECT_TRUE(flight.session.hasAutopilot(flight.now_ns));
  EXPECT_EQ(flight.session.counters().lost, 0);
  EXPECT_NEAR(flight.session.clock()->round_trip_s, 4e-3, 1e-9);
}

TEST(MavlinkSession, TakesTheNextMessageOfAnImuThatItHas) {
  Flight flight;
  flight.autopilot.type = 3;
  flight.autopilot.has = {RawImu::kId, ScaledImu2::kId};
  flight.run(8000);
  const auto readings = flight.take<ImuReading>();
  EXPECT_GT(readings.size(), 200U);
  EXPECT_EQ(flight.autopilot.intervals_us.count(ScaledImu2::kId), 0U) << "not asked for: RAW_IMU comes";
  EXPECT_NEAR(readings.back().accel.z(), 9.80665, 1e-9);
}

TEST(MavlinkSession, UsesOneImuOfSeveral) {
  Flight flight;
  flight.autopilot.type = 3;
  flight.autopilot.has = {HighresImu::kId, RawImu::kId, ScaledImu2::kId};
  for (const uint32_t id : kImuMessages) flight.autopilot.intervals_us[id] = 5000;
  flight.run(3000);
  flight.take<ImuReading>();
  flight.run(1000);
  for (const auto& reading : flight.take<ImuReading>()) EXPECT_NEAR(reading.accel.z(), 9.81, 1e-5);
}

TEST(MavlinkSession, ASampleIsPublishedOnceAndABurstInOrder) {
  Flight flight;
  flight.run(3000);
  flight.take<ImuReading>();
  HighresImu m;
  m.zacc = -9.81F;
  m.fields_updated = 0xffff;
  const auto send = [&](uint64_t us) {
    m.time_usec = us;
    const Bytes frame = flight.autopilot.encoder.encode(m);
    for (auto& each : flight.session.receive(frame.data(), frame.size(), flight.now_ns, true))
      flight.measurements.push_back(each);
  };
  const uint64_t now_us = flight.autopilot.microseconds(flight.now_ns);
  send(now_us);
  send(now_us);
  send(now_us - 3);
  EXPECT_EQ(flight.take<ImuReading>().size(), 1U) << "one of them is new";
  for (uint64_t i = 1; i <= 5; ++i) send(now_us + i);
  const auto burst = flight.take<ImuReading>();
  ASSERT_EQ(burst.size(), 5U);
  for (size_t i = 1; i < burst.size(); ++i) EXPECT_GT(burst[i].time, burst[i - 1].time);
}

TEST(MavlinkSession, ARebootGivesNoWrongTime) {
  Flight flight;
  flight.run(4000);
  flight.take<ImuReading>();
  flight.autopilot.reboot(flight.now_ns);
  for (const uint32_t id : kImuMessages)
    flight.autopilot.intervals_us[id] = 5000;  // it streams before it is asked
  flight.run(3000);
  const auto readings = flight.take<ImuReading>();
  EXPECT_GT(readings.size(), 300U);
  for (const auto& reading : readings) {
    const int64_t us = toUtime(reading.time);
    EXPECT_LE(std::abs(us - (us + 2500) / 5000 * 5000), 1) << us;
  }
  EXPECT_EQ(flight.session.counters().clock_restarts, 1);
  EXPECT_GT(flight.session.counters().other_times, 0);
}

/// As over a telemetry link, whose streams are set by others and which hands no requests on.
TEST(MavlinkSession, TakesTheAttitudeInAnglesWhereTheQuaternionDoesNotCome) {
  for (const bool has_quaternion : {false, true}) {
    Flight flight;
    flight.autopilot.streamed_attitude = Attitude{0, 0.1F, -0.2F, 2.5F, 0, 0, 0};
    if (!has_quaternion) flight.autopilot.has = {HighresImu::kId};
    flight.run(4000);
    flight.measurements.clear();
    flight.run(2000);
    const auto poses = flight.take<Pose>();
    const size_t rate = has_quaternion ? static_cast<size_t>(flight.parameters.attitude_rate_hz) : 2;
    EXPECT_NEAR(static_cast<double>(poses.size()), 2.0 * static_cast<double>(rate), 2);
    if (has_quaternion) continue;
    ASSERT_FALSE(poses.empty());
    // Yaw 2.5 from north over east; pitch -0.2 is nose down; roll 0.1 lowers the right side.
    const Eigen::Matrix3d R = poses.back().enu_from_flu.toRotationMatrix();
    EXPECT_NEAR(std::atan2(R(0, 0), R(1, 0)), 2.5, 1e-6);
    EXPECT_NEAR(R(2, 0), std::sin(-0.2), 1e-6);
    EXPECT_NEAR(R(2, 1), std::sin(0.1) * std::cos(0.2), 1e-6);
  }
}

TEST(MavlinkSession, AsksAgainAfterAReboot) {
  Flight flight;
  flight.run(4000);
  flight.autopilot.reboot(flight.now_ns);
  flight.run(4000);
  EXPECT_EQ(flight.autopilot.intervals_us.count(HighresImu::kId), 1U);
}

TEST(MavlinkSession, IgnoresOtherVehiclesAndOtherComponents) {
  Flight flight;
  flight.run(3000);
  flight.take<ImuReading>();
  HighresImu m;
  m.time_usec = flight.autopilot.microseconds(flight.now_ns);
  m.zacc = -5;
  m.fields_updated = 0xffff;
  for (const auto& [system, component] : {std::pair<uint8_t, uint8_t>{2, 1}, {1, 154}}) {
    const Bytes frame = Encoder(system, component).encode(m);
    EXPECT_TRUE(flight.session.receive(frame.data(), frame.size(), flight.now_ns, true).empty());
  }
}

TEST(MavlinkSession, AnswersTimesync) {
  Flight flight;
  const Bytes request = vectors::bytesOf(vectors::kTimesync);
  flight.session.receive(request.data(), request.size(), 77, true);
  Parser parser;
  bool is_answered = false;
  for (const Bytes& frame : flight.session.dueFrames(100)) {
    parser.feed(frame.data(), frame.size());
    while (const auto each = parser.next()) {
      if (each->id != Timesync::kId || each->message<Timesync>().tc1 == 0) continue;
      is_answered = true;
      EXPECT_EQ(each->message<Timesync>().ts1, 1'234'567'890'123);
      EXPECT_EQ(each->message<Timesync>().tc1, 77);
    }
  }
  // The vector asks component 1, not us: nothing is to be answered.
  EXPECT_FALSE(is_answered);
  const Bytes ours = Encoder(1, 1).encode(Timesync{0, 1'234'567'890'123, 0, 0});
  flight.session.receive(ours.data(), ours.size(), 77, true);
  for (const Bytes& frame : flight.session.dueFrames(100)) {
    parser.feed(frame.data(), frame.size());
    while (const auto each = parser.next()) is_answered |= each->message<Timesync>().tc1 == 77;
  }
  EXPECT_TRUE(is_answered);
}

TEST(MavlinkSession, AKeyRefusesTheUnsigned) {
  AutopilotParameters parameters;
  const SigningKey key = *signingKeyOf(vectors::kKey);
  const SigningTime now = signingTimeOf(1'767'225'600'000'000);
  Session session(parameters, key, now);
  const Bytes plain = vectors::bytesOf(vectors::kHeartbeat2);
  session.receive(plain.data(), plain.size(), 1, true);
  EXPECT_FALSE(session.hasAutopilot(1));
  EXPECT_EQ(session.counters().unsigned_frames, 1);
  const Bytes good = vectors::bytesOf(vectors::kSignedHeartbeat);
  session.receive(good.data(), good.size(), 1, true);
  EXPECT_TRUE(session.hasAutopilot(1));
  session.receive(good.data(), good.size(), 1, true);
  EXPECT_EQ(session.counters().bad_signatures, 1);
  for (const Bytes& frame : session.dueFrames(2)) EXPECT_EQ(frame[2], kSigned);
}

}  // namespace
}  // namespace redbee::mavlink
