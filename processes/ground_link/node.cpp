#include "processes/ground_link/node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "processes/link/signing_key.hpp"
#include "processes/plausible_subscription.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/mavlink/peer_check.hpp"
#include "redbee/node/host_clock.hpp"

namespace redbee {
namespace {

constexpr int kStatusQueue = 64;
constexpr int64_t kTargetsLast_ns = 2'000'000'000;

mavlink::ObjectPlace placeOf(const target_t& target, const targets_t& of) {
  mavlink::ObjectPlace place;
  place.latitude_deg = target.latitude;
  place.longitude_deg = target.longitude;
  place.altitude_m =
      of.has_ground_altitude != 0 ? of.ground_altitude : std::numeric_limits<double>::quiet_NaN();
  place.sigma_m = std::sqrt(target.position_covariance[0] + target.position_covariance[3]);
  place.east_m_s = target.velocity[0];
  place.north_m_s = target.velocity[1];
  place.velocity_sigma_m_s = std::sqrt(target.velocity_covariance[0] + target.velocity_covariance[3]);
  place.distance_m = target.range;
  if (of.has_view != 0) {
    place.distance_m = std::hypot(target.position[0] - of.camera_position[0],
                                  target.position[1] - of.camera_position[1], of.camera_height);
  }
  return place;
}

/// Any ground station: their identities are not configured.
PeerCheck peerOf(const GroundLinkParameters& link) {
  return [system = std::optional<uint8_t>(), key = readSigningKey(link.signing_key_file)](
             const mavlink::Bytes& datagram) { return mavlink::holdsFrameOf(datagram, system, key); };
}

}  // namespace

GroundLinkNode::GroundLinkNode(Bus& bus, const Configuration& configuration)
    : GroundLinkNode(
          bus, configuration,
          linkOf("ground_link.link", configuration.ground_link.link, peerOf(configuration.ground_link)),
          hostNanoseconds) {}

GroundLinkNode::GroundLinkNode(Bus& bus, const Configuration& configuration, std::unique_ptr<Link> link,
                               Clock clock)
    : configuration_(configuration),
      health_(programName(kGroundLink), configurationHash(configuration)),
      link_(configuration.ground_link.link, std::move(link), std::move(clock)),
      camera_(configuration.ground_link, configuration.camera.width, configuration.camera.height,
              readSigningKey(configuration.ground_link.signing_key_file), signingTimeOfDay()) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration.channels;
  subscriptions_.push_back(subscribePlausible<detections_t>(
      bus, channels.detections, kStatusQueue, [this](const detections_t& m) { show(m); }, damaged));
  subscriptions_.push_back(subscribePlausible<targets_t>(
      bus, channels.targets, kStatusQueue,
      [this](const targets_t& m) {
        targets_ = m;
        targets_ns_ = link_.now();
      },
      damaged));
}

void GroundLinkNode::show(const detections_t& message) {
  health_.noteSequence(configuration_.channels.detections, message.sequence);
  health_.noteInput(fromUtime(message.utime));
  const double width = configuration_.camera.width, height = configuration_.camera.height;
  const auto inside = [](double relative) { return std::min(1.0, std::max(0.0, relative)); };
  std::map<int, mavlink::TrackedObject> objects;
  for (const detection_t& d : message.detections) {
    mavlink::TrackedObject& object = objects[d.id];
    object.id = d.id;
    object.is_seen = d.seen != 0;
    object.box = mavlink::RelativeBox{inside(d.x / width), inside(d.y / height),
                                      inside((d.x + d.width) / width), inside((d.y + d.height) / height)};
  }
  if (targets_ && link_.now() - targets_ns_ < kTargetsLast_ns && targets_->has_global != 0) {
    for (const target_t& target : targets_->targets) {
      mavlink::TrackedObject& object = objects[target.id];
      object.id = target.id;
      object.place = placeOf(target, *targets_);
    }
  }
  std::vector<mavlink::TrackedObject> shown;
  shown.reserve(objects.size());
  for (const auto& [id, object] : objects) shown.push_back(object);
  camera_.show(std::move(shown), link_.now());
}

bool GroundLinkNode::processNext() {
  if (link_.open([this] { camera_.reconnect(); })) {
    for (const mavlink::Bytes& frame : camera_.dueFrames(link_.now())) link_.send(frame);
    const ReceivedBytes received = link_.receive();
    camera_.receive(received.data.data(), received.data.size(), received.host_ns, link_.isDatagram());
  }
  noteCounters();
  describeState();
  return true;
}

void GroundLinkNode::noteCounters() {
  const int64_t bad = camera_.trust().badSignatures();
  const int64_t damaged = camera_.parserCounters().crc_errors + bad;
  health_.noteDamaged(damaged - std::exchange(reported_damaged_, damaged));
  health_.noteLost(camera_.lost() - std::exchange(reported_lost_, camera_.lost()));
  const int64_t refused = camera_.trust().unsignedFrames() + bad;
  if (refused > std::exchange(reported_unsigned_, refused))
    health_.noteIgnored(link_.name(), "commands without a right signature are refused");
  if (camera_.picked() == picked_) return;
  picked_ = camera_.picked();
  spdlog::info("{}", picked_ ? "object " + std::to_string(*picked_) + " is picked" : "nobody is picked");
}

void GroundLinkNode::describeState() {
  if (!link_.fault().empty()) return health_.setState(HealthState::kDegraded, link_.fault());
  if (health_.inputs() == 0) {
    return health_.setState(HealthState::kDegraded, "no " + configuration_.channels.detections + " has come");
  }
  if (!configuration_.geolocation.enabled) {
    return health_.setState(HealthState::kGood, "places are not sent: geolocation.enabled is false");
  }
  health_.setState(HealthState::kGood, picked_ ? "object " + std::to_string(*picked_) + " is picked" : "");
}

}  // namespace redbee
