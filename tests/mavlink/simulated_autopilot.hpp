// An autopilot and its link, on simulated clocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "redbee/mavlink/attitude_message.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "redbee/mavlink/session.hpp"

namespace redbee::mavlink {

inline constexpr int64_t kMs = 1'000'000;

/// Answers TIMESYNC, and sends at 200 Hz the message of an IMU that was asked for, of those that it has.
class Autopilot {
 public:
  uint8_t type = 12;
  std::vector<uint32_t> has{HighresImu::kId, AttitudeQuaternion::kId};
  int64_t boot_ns = 7'000'000'000;  ///< our clock
  Encoder encoder{1, 1};
  std::optional<Attitude> streamed_attitude;  ///< twice a second, though nobody asks for it
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
    if (streamed_attitude && now_ns / kMs % 500 == 0) {
      streamed_attitude->time_boot_ms = ms;
      frames.push_back(encoder.encode(*streamed_attitude));
    }
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

}  // namespace redbee::mavlink
