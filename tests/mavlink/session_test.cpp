// The conversation with a simulated autopilot, on simulated clocks.
#include "redbee/mavlink/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "tests/mavlink/vectors.hpp"

namespace redbee::mavlink {
namespace {

constexpr int64_t kMs = 1'000'000;

/// Answers TIMESYNC, and sends at 200 Hz the message of an IMU that was asked for, of those that it has.
class Autopilot {
 public:
  uint8_t type = 12;
  std::vector<uint32_t> has{HighresImu::kId, AttitudeQuaternion::kId};
  int64_t boot_ns = 7'000'000'000;  ///< our clock
  Encoder encoder{1, 1};
  std::map<uint32_t, float> intervals_us;
  int heartbeats_heard = 0;

  uint64_t microseconds(int64_t now_ns) const { return static_cast<uint64_t>((now_ns - boot_ns) / 1000); }
  void reboot(int64_t now_ns) {
    boot_ns = now_ns - 2'000 * kMs;
    intervals_us.clear();
    encoder = Encoder(1, 1);
  }

  void hear(const Bytes& bytes, int64_t now_ns, std::vector<Bytes>& answers) {
    parser_.feed(bytes.data(), bytes.size());
    while (const auto frame = parser_.next()) {
      if (frame->id == Heartbeat::kId) heartbeats_heard += frame->message<Heartbeat>().type == 18 ? 1 : 0;
      if (frame->id == Timesync::kId) {
        const auto m = frame->message<Timesync>();
        if (m.tc1 == 0)
          answers.push_back(
              encoder.encode(Timesync{now_ns - boot_ns, m.ts1, frame->system, frame->component}));
      }
      if (frame->id == CommandLong::kId) {
        const auto m = frame->message<CommandLong>();
        const auto id = static_cast<uint32_t>(m.param[0]);
        if (std::find(has.begin(), has.end(), id) != has.end()) intervals_us[id] = m.param[1];
      }
    }
  }

  std::vector<Bytes> speak(int64_t now_ns) {
    std::vector<Bytes> frames;
    if (now_ns / kMs % 1000 == 0) frames.push_back(encoder.encode(Heartbeat{0, 2, type, 0, 4, 3}));
    const auto is_due = [&](uint32_t id) {
      const auto at = intervals_us.find(id);
      return at != intervals_us.end() && now_ns / kMs % std::lround(at->second / 1000) == 0;
    };
    const auto ms = static_cast<uint32_t>(microseconds(now_ns) / 1000);
    if (is_due(HighresImu::kId)) {
      HighresImu m;
      m.time_usec = microseconds(now_ns);
      m.zacc = -9.81F;
      m.fields_updated = 0xffff;
      frames.push_back(encoder.encode(m));
    }
    if (is_due(RawImu::kId)) frames.push_back(encoder.encode(RawImu{microseconds(now_ns), 0, 0, -1000}));
    if (is_due(ScaledImu2::kId)) frames.push_back(encoder.encode(ScaledImu2{ms, 0, 0, -1000}));
    if (is_due(AttitudeQuaternion::kId)) frames.push_back(encoder.encode(AttitudeQuaternion{ms}));
    return frames;
  }

 private:
  Parser parser_;
};

/// A link of 2 ms each way, in steps of a millisecond.
struct Flight {
  static constexpr int64_t kDelay = 2 * kMs;
  AutopilotParameters parameters;
  Autopilot autopilot;
  Session session{parameters, std::nullopt, 0};
  int64_t now_ns = 50'000'000'000;
  std::vector<Measurement> measurements;
  std::vector<std::pair<int64_t, Bytes>> to_us, to_autopilot;  ///< by time of arrival

  void run(int milliseconds) {
    for (const int64_t end = now_ns + milliseconds * kMs; now_ns < end; now_ns += kMs) {
      std::vector<Bytes> answers;
      for (const auto& [when, bytes] : to_autopilot) {
        if (when == now_ns) autopilot.hear(bytes, now_ns, answers);
      }
      for (const Bytes& frame : autopilot.speak(now_ns)) answers.push_back(frame);
      for (Bytes& frame : answers) to_us.emplace_back(now_ns + kDelay, std::move(frame));
      for (const auto& [when, bytes] : to_us) {
        if (when != now_ns) continue;
        for (auto& each : session.receive(bytes.data(), bytes.size(), now_ns, true))
          measurements.push_back(each);
      }
      for (Bytes& frame : session.dueFrames(now_ns))
        to_autopilot.emplace_back(now_ns + kDelay, std::move(frame));
      const auto is_past = [&](const auto& each) { return each.first <= now_ns; };
      to_us.erase(std::remove_if(to_us.begin(), to_us.end(), is_past), to_us.end());
      to_autopilot.erase(std::remove_if(to_autopilot.begin(), to_autopilot.end(), is_past),
                         to_autopilot.end());
    }
  }
  template <typename Kind>
  std::vector<Kind> take() {
    std::vector<Kind> of_kind;
    for (const auto& each : measurements) {
      if (const auto* value = std::get_if<Kind>(&each)) of_kind.push_back(*value);
    }
    measurements.clear();
    return of_kind;
  }
};

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
