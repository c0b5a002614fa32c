// The conversation with one autopilot: bytes in, measurements out, bytes to send. Knows no device and no
// clock.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "redbee/mavlink/clock_estimator.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/measurements.hpp"
#include "redbee/mavlink/message_rates.hpp"
#include "redbee/mavlink/parameters.hpp"
#include "redbee/mavlink/parser.hpp"
#include "redbee/mavlink/sequence_loss.hpp"
#include "redbee/mavlink/trust.hpp"
#include "redbee/mavlink/vehicle_state.hpp"

namespace redbee::mavlink {

struct SessionCounters {
  ParserCounters parser;
  int64_t lost = 0;             ///< frames, by the sequence numbers
  int64_t unsigned_frames = 0;  ///< refused because a key is given
  int64_t bad_signatures = 0;   ///< refused: another key, or recorded earlier
  int64_t other_times = 0;      ///< measurements whose times are not those of TIMESYNC's clock: left out
  int64_t clock_restarts = 0;   ///< the autopilot was started again, or its clock was set
};

class Session {
 public:
  static constexpr uint8_t kComponent = 191;         ///< ours: MAV_COMP_ID_ONBOARD_COMPUTER
  static constexpr uint8_t kAutopilotComponent = 1;  ///< MAV_COMP_ID_AUTOPILOT1
  static constexpr int64_t kTimesyncPeriod_ns = 100'000'000;
  static constexpr int64_t kHeartbeatPeriod_ns = 1'000'000'000;
  static constexpr int64_t kSilence_ns = 3'000'000'000;  ///< without a heartbeat the autopilot is away

  /// `key`: frames are signed, and only signed ones are listened to. `now`: of the signatures.
  Session(const AutopilotParameters& parameters, const std::optional<SigningKey>& key, SigningTime now);

  /// What the link has received at this time of our clock [ns]. `is_datagram`: it holds whole frames.
  std::vector<Measurement> receive(const uint8_t* data, size_t size, int64_t host_ns, bool is_datagram);
  /// What is due, to be sent at this time: heartbeat, TIMESYNC, requests for rates, answers. To be called
  /// often.
  std::vector<Bytes> dueFrames(int64_t host_ns);
  /// The device was opened again: what was half received is lost. The clock is kept, the autopilot may have
  /// gone on.
  void reconnect();

  SessionCounters counters() const;
  /// A heartbeat of the autopilot is at most kSilence_ns old.
  bool hasAutopilot(int64_t host_ns) const;
  std::optional<ClockState> clock() const { return clock_.state(); }
  /// "PX4", "ArduPilot", "autopilot" or "": none was heard.
  std::string autopilotName() const;

 private:
  void handle(const Frame& frame, int64_t host_ns);
  void handleHeartbeat(const Heartbeat& message, int64_t host_ns);
  void handleTimesync(const Frame& frame, int64_t host_ns);
  void handleSensors(const Frame& frame, int64_t host_ns);
  void handleAttitude(const AttitudeQuaternion& message, int64_t host_ns);
  void handleCamera(const Frame& frame, int64_t host_ns);
  template <typename Message>
  void handleImu(const Frame& frame, int64_t host_ns);
  /// The autopilot's time on our clock; std::nullopt where that is not known or cannot be.
  std::optional<ImuTime> timeOf(uint64_t device_us, int64_t host_ns);
  /// The same of time_boot_ms. Other components have clocks of their own: what they send is stamped on
  /// arrival.
  std::optional<ImuTime> bootTimeOf(const Frame& frame, uint32_t time_boot_ms, int64_t host_ns);
  bool isOfAutopilot(const Frame& frame) const { return frame.component == kAutopilotComponent; }
  void ask(const RateRequest& request, uint8_t component);
  template <typename Message>
  void send(const Message& message) {
    outgoing_.push_back(encoder_.encode(message));
  }

  AutopilotParameters parameters_;
  Parser parser_;
  Encoder encoder_;
  Trust trust_;
  SequenceLoss loss_;
  SessionCounters counters_;
  ClockEstimator clock_;
  VehicleState vehicle_;
  MessageRates rates_;
  std::set<int64_t> asked_;  ///< TIMESYNC requests without an answer: our time, which they hold
  std::optional<int64_t> heartbeat_ns_;
  uint8_t autopilot_ = 0;  ///< MAV_AUTOPILOT
  std::optional<int64_t> gimbal_device_ns_;
  std::optional<uint8_t> camera_component_;  ///< of a camera that speaks for itself
  std::optional<int64_t> field_of_view_ns_;  ///< of the last CAMERA_FOV_STATUS that says it
  std::optional<int64_t> quaternion_ns_;     ///< of the last ATTITUDE_QUATERNION
  std::optional<ImuReading> last_imu_;       ///< since the clock was last set
  int64_t next_timesync_ns_ = 0;
  int64_t next_heartbeat_ns_ = 0;
  std::vector<Bytes> outgoing_;
  std::vector<Measurement> measurements_;
};

}  // namespace redbee::mavlink
