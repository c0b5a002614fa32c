#include "processes/autopilot/node.hpp"

#include <spdlog/spdlog.h>

#include <utility>
#include <variant>

#include "processes/autopilot/measurement_messages.hpp"
#include "processes/link/signing_key.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/mavlink/peer_check.hpp"
#include "redbee/node/host_clock.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {
namespace {

constexpr int64_t kImuSilence_ns = 1'000'000'000;
constexpr int64_t kPoseSilence_ns = 3'000'000'000;
constexpr double kMaxClockSigma_s = 0.02;  // more than half a frame's distance is of no use

/// The configured vehicle, whoever else sends to the port.
PeerCheck peerOf(const AutopilotParameters& link) {
  return [system = static_cast<uint8_t>(link.system_id), key = readSigningKey(link.signing_key_file)](
             const mavlink::Bytes& datagram) { return mavlink::holdsFrameOf(datagram, system, key); };
}

}  // namespace

AutopilotNode::AutopilotNode(Bus& bus, const Configuration& configuration)
    : AutopilotNode(bus, configuration,
                    linkOf("autopilot.link", configuration.autopilot.link, peerOf(configuration.autopilot)),
                    hostNanoseconds) {}

AutopilotNode::AutopilotNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Link> link,
                             Clock clock)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kAutopilot), configurationHash(configuration)),
      link_(configuration.autopilot.link, std::move(link), std::move(clock)),
      session_(configuration.autopilot, readSigningKey(configuration.autopilot.signing_key_file),
               signingTimeOfDay()) {
  health_.explainsSilence();
}

bool AutopilotNode::processNext() {
  if (link_.open([this] { session_.reconnect(); })) {
    send(link_.now());
    const ReceivedBytes received = link_.receive();
    for (const auto& each :
         session_.receive(received.data.data(), received.data.size(), received.host_ns, link_.isDatagram())) {
      publish(each);
    }
  }
  noteCounters();
  describeState(link_.now());
  return true;
}

void AutopilotNode::send(int64_t now_ns) {
  for (const mavlink::Bytes& frame : session_.dueFrames(now_ns)) link_.send(frame);
}

void AutopilotNode::publish(const mavlink::Measurement& measurement) {
  const auto& channels = configuration_.channels;
  const auto publishOn = [&](const std::string& channel, const auto& message) {
    if (isPlausible(message)) {
      bus_.publish(channel, message);
    } else {
      health_.noteDamaged();
    }
  };
  if (const auto* imu = std::get_if<mavlink::ImuReading>(&measurement)) {
    const Duration time = imu->time.time_since_epoch();
    health_.noteInput(time);
    publishOn(channels.imu, messageOf(*imu));
    health_.notePublished(time);
    imu_ns_ = link_.now();
  } else if (const auto* height = std::get_if<mavlink::HeightReading>(&measurement)) {
    publishOn(channels.altimeter, messageOf(*height));
  } else if (const auto* pose = std::get_if<mavlink::Pose>(&measurement)) {
    publishOn(channels.pose, messageOf(*pose));
    pose_ns_ = link_.now();
  } else if (const auto* gimbal = std::get_if<mavlink::GimbalAttitude>(&measurement)) {
    publishOn(channels.gimbal, messageOf(*gimbal));
  } else if (const auto* lens = std::get_if<mavlink::Lens>(&measurement)) {
    publishOn(channels.lens, messageOf(*lens));
  } else if (const auto* clock = std::get_if<mavlink::ClockState>(&measurement)) {
    publishOn(channels.autopilot_clock, messageOf(*clock));
  }
}

void AutopilotNode::noteCounters() {
  const mavlink::SessionCounters now = session_.counters();
  const std::string& link = link_.name();
  health_.noteDamaged(now.parser.crc_errors - reported_.parser.crc_errors);
  health_.noteDamaged(now.bad_signatures - reported_.bad_signatures);
  health_.noteLost(now.lost - reported_.lost);
  if (now.unsigned_frames > reported_.unsigned_frames)
    health_.noteIgnored(link, "unsigned frames are refused");
  if (now.bad_signatures > reported_.bad_signatures) {
    health_.noteIgnored(link, "frames with a wrong or repeated signature are refused");
  }
  if (now.other_times > reported_.other_times) {
    health_.noteIgnored(link, "measurements whose times are not those of TIMESYNC are left out");
  }
  if (now.clock_restarts > reported_.clock_restarts) {
    spdlog::warn("{}: the autopilot was started again, or its clock was set", link);
  }
  reported_ = now;
}

void AutopilotNode::describeState(int64_t now_ns) {
  const std::string& link = link_.name();
  const std::string system = "system " + std::to_string(configuration_.autopilot.system_id);
  const auto degraded = [&](const std::string& why) { health_.setState(HealthState::kDegraded, why); };
  if (!link_.fault().empty()) return degraded(link_.fault());
  if (!session_.hasAutopilot(now_ns)) return degraded(link + ": no heartbeat of " + system);
  const auto clock = session_.clock();
  if (!clock)
    return degraded(session_.autopilotName() + " has not answered TIMESYNC yet: its times are not known");
  if (clock->sigma_s > kMaxClockSigma_s)
    return degraded("the autopilot's clock is known to more than 20 ms only");
  if (now_ns - imu_ns_ > kImuSilence_ns)
    return degraded(session_.autopilotName() + " sends no message of an IMU");
  if (configuration_.geolocation.enabled && now_ns - pose_ns_ > kPoseSilence_ns) {
    return degraded(session_.autopilotName() + " sends no attitude: there is no " +
                    configuration_.channels.pose);
  }
  health_.setState(HealthState::kGood);
}

}  // namespace redbee
