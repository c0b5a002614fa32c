#include "processes/autopilot/node.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>
#include <utility>
#include <variant>

#include "processes/autopilot/measurement_messages.hpp"
#include "processes/autopilot/signing_key.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/node/host_clock.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kPass{20};
constexpr int64_t kImuSilence_ns = 1'000'000'000;
constexpr double kMaxClockSigma_s = 0.02;  // more than half a frame's distance is of no use

std::unique_ptr<Link> configuredLink(const AutopilotParameters& autopilot) {
  const auto address = mavlink::linkAddressOf(autopilot.link);
  if (!address) {
    throw UserError("autopilot.link: is not set in this configuration; set it to " +
                    std::string(mavlink::kLinkForms));
  }
  return makeLink(*address);
}

mavlink::SigningTime signingTimeNow() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return mavlink::signingTimeOf(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

}  // namespace

AutopilotNode::AutopilotNode(Bus& bus, const Configuration& configuration)
    : AutopilotNode(bus, configuration, configuredLink(configuration.autopilot), hostNanoseconds) {}

AutopilotNode::AutopilotNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Link> link,
                             Clock clock)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kAutopilot), configurationHash(configuration)),
      link_(std::move(link)),
      clock_(std::move(clock)),
      session_(configuration.autopilot, readSigningKey(configuration.autopilot.signing_key_file),
               signingTimeNow()) {
  health_.explainsSilence();
}

bool AutopilotNode::openLink() {
  if (link_->isOpen()) return true;
  const int64_t now_ns = clock_();
  if (!back_off_.isDue(now_ns)) {
    std::this_thread::sleep_for(kPass);
    return false;
  }
  const std::string fault = link_->open();
  if (fault.empty()) {
    spdlog::info("{}: open", configuration_.autopilot.link);
    session_.reconnect();
    link_fault_.clear();
    return true;
  }
  if (fault != link_fault_) spdlog::warn("{}", fault);
  link_fault_ = fault;
  back_off_.postpone(now_ns);
  return false;
}

bool AutopilotNode::processNext() {
  if (openLink()) {
    send(clock_());
    const ReceivedBytes received = link_->receive(kPass);
    if (!received.data.empty()) back_off_.reset();
    for (const auto& each : session_.receive(received.data.data(), received.data.size(), received.host_ns,
                                             link_->isDatagram())) {
      publish(each);
    }
    if (!link_->isOpen()) {
      link_fault_ = configuration_.autopilot.link + ": the device is gone";
      spdlog::warn("{}", link_fault_);
      back_off_.postpone(clock_());
    }
  }
  noteCounters();
  describeState(clock_());
  return true;
}

void AutopilotNode::send(int64_t now_ns) {
  for (const mavlink::Bytes& frame : session_.dueFrames(now_ns)) link_->send(frame);
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
    imu_ns_ = clock_();
  } else if (const auto* height = std::get_if<mavlink::HeightReading>(&measurement)) {
    publishOn(channels.altimeter, messageOf(*height));
  } else if (const auto* pose = std::get_if<mavlink::Pose>(&measurement)) {
    publishOn(channels.pose, messageOf(*pose));
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
  const std::string& link = configuration_.autopilot.link;
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
  const std::string& link = configuration_.autopilot.link;
  const std::string system = "system " + std::to_string(configuration_.autopilot.system_id);
  const auto degraded = [&](const std::string& why) { health_.setState(HealthState::kDegraded, why); };
  if (!link_fault_.empty()) return degraded(link_fault_);
  if (!session_.hasAutopilot(now_ns)) return degraded(link + ": no heartbeat of " + system);
  const auto clock = session_.clock();
  if (!clock)
    return degraded(session_.autopilotName() + " has not answered TIMESYNC yet: its times are not known");
  if (clock->sigma_s > kMaxClockSigma_s)
    return degraded("the autopilot's clock is known to more than 20 ms only");
  if (now_ns - imu_ns_ > kImuSilence_ns)
    return degraded(session_.autopilotName() + " sends no message of an IMU");
  health_.setState(HealthState::kGood);
}

}  // namespace redbee
