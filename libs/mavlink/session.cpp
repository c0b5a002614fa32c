#include "redbee/mavlink/session.hpp"

#include <iterator>
#include <utility>

namespace redbee::mavlink {
namespace {

constexpr uint8_t kOnboardController = 18;  // MAV_TYPE
constexpr uint8_t kNoAutopilot = 8;         // MAV_AUTOPILOT_INVALID
constexpr uint8_t kActive = 4;              // MAV_STATE
constexpr uint8_t kFirstCamera = 100;       // MAV_COMP_ID_CAMERA
constexpr uint8_t kLastCamera = 105;
constexpr size_t kMostAsked = 32;  // three seconds of requests: an answer that is later is of no use

}  // namespace

Session::Session(const AutopilotParameters& parameters, const std::optional<SigningKey>& key, SigningTime now)
    : parameters_(parameters),
      encoder_(static_cast<uint8_t>(parameters.system_id), kComponent),
      trust_(key, now, encoder_),
      vehicle_(parameters),
      rates_(parameters) {}

std::vector<Measurement> Session::receive(const uint8_t* data, size_t size, int64_t host_ns,
                                          bool is_datagram) {
  parser_.feed(data, size);
  if (is_datagram) parser_.endOfDatagram();
  while (const auto frame = parser_.next()) {
    if (frame->system != parameters_.system_id) continue;
    loss_.note(*frame);
    if (trust_.accepts(*frame, encoder_)) handle(*frame, host_ns);
  }
  return std::exchange(measurements_, {});
}

void Session::handle(const Frame& frame, int64_t host_ns) {
  switch (frame.id) {
    case Timesync::kId:
      return handleTimesync(frame, host_ns);
    case GimbalDeviceAttitudeStatus::kId:
    case MountOrientation::kId:
    case CameraInformation::kId:
    case CameraSettings::kId:
    case CameraFovStatus::kId:
      return handleCamera(frame, host_ns);
    case DistanceSensor::kId: {
      rates_.noteMessage(frame.id);
      const auto message = frame.message<DistanceSensor>();
      const auto time = bootTimeOf(frame, message.time_boot_ms, host_ns);
      const auto height = time ? vehicle_.heightOf(message, *time) : std::nullopt;
      if (height) measurements_.emplace_back(*height);
      return;
    }
    default:
      if (frame.id == Heartbeat::kId && frame.component >= kFirstCamera && frame.component <= kLastCamera)
        camera_component_ = frame.component;
      if (isOfAutopilot(frame)) handleSensors(frame, host_ns);
  }
}

void Session::handleHeartbeat(const Heartbeat& message, int64_t host_ns) {
  if (message.autopilot == kNoAutopilot) return;
  if (autopilot_ != message.autopilot || !hasAutopilot(host_ns)) rates_.restart();
  autopilot_ = message.autopilot;
  heartbeat_ns_ = host_ns;
}

void Session::handleTimesync(const Frame& frame, int64_t host_ns) {
  const auto message = frame.message<Timesync>();
  if (message.tc1 == 0) {
    if (message.target_system != 0 && message.target_system != parameters_.system_id) return;
    if (message.target_component != 0 && message.target_component != kComponent) return;
    return send(Timesync{host_ns, message.ts1, frame.system, frame.component});
  }
  // Answers to others on the link, and what nobody asked for, do not repeat a time of ours.
  const auto asked = asked_.find(message.ts1);
  if (!isOfAutopilot(frame) || asked == asked_.end()) return;
  asked_.erase(asked_.begin(), std::next(asked));
  if (message.tc1 < 0 || message.tc1 > TimesyncExchange::kMaxTime_ns || host_ns < message.ts1) return;
  const auto outcome = clock_.add({message.ts1, message.tc1, host_ns});
  if (outcome == ClockEstimator::Outcome::kRestarted) {
    ++counters_.clock_restarts;
    rates_.restart();
    last_imu_.reset();
  }
  if (const auto state = clock_.state()) measurements_.emplace_back(*state);
}

void Session::ask(const RateRequest& request, uint8_t component) {
  send(CommandLong{{static_cast<float>(request.id), static_cast<float>(1e6 / request.rate_hz)},
                   CommandLong::kSetMessageInterval,
                   static_cast<uint8_t>(parameters_.system_id),
                   component,
                   0});
}

std::vector<Bytes> Session::dueFrames(int64_t host_ns) {
  trust_.advanceTo(host_ns, encoder_);
  if (host_ns >= next_heartbeat_ns_) {
    next_heartbeat_ns_ = host_ns + kHeartbeatPeriod_ns;
    send(Heartbeat{0, kOnboardController, kNoAutopilot, 0, kActive, 3});
  }
  if (hasAutopilot(host_ns)) {
    for (const RateRequest& request : rates_.due(host_ns)) {
      ask(request, kAutopilotComponent);
      if (request.id == CameraFovStatus::kId && camera_component_) ask(request, *camera_component_);
    }
  }
  std::vector<Bytes> frames = std::exchange(outgoing_, {});
  if (host_ns >= next_timesync_ns_) {
    next_timesync_ns_ = host_ns + kTimesyncPeriod_ns;
    asked_.insert(host_ns);
    if (asked_.size() > kMostAsked) asked_.erase(asked_.begin());
    frames.push_back(encoder_.encode(
        Timesync{0, host_ns, static_cast<uint8_t>(parameters_.system_id), kAutopilotComponent}));
  }
  return frames;
}

void Session::reconnect() {
  parser_.endOfDatagram();
  while (parser_.next()) {
  }
  asked_.clear();
}

SessionCounters Session::counters() const {
  SessionCounters counters = counters_;
  counters.parser = parser_.counters();
  counters.lost = loss_.lost();
  counters.unsigned_frames = trust_.unsignedFrames();
  counters.bad_signatures = trust_.badSignatures();
  return counters;
}

bool Session::hasAutopilot(int64_t host_ns) const {
  return heartbeat_ns_ && host_ns - *heartbeat_ns_ <= kSilence_ns;
}

std::string Session::autopilotName() const {
  if (!heartbeat_ns_) return "";
  return autopilot_ == Heartbeat::kPx4         ? "PX4"
         : autopilot_ == Heartbeat::kArduPilot ? "ArduPilot"
                                               : "autopilot";
}

}  // namespace redbee::mavlink
