#include "processes/redbee/export/recorded_targets.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <memory>

#include "processes/geolocation/node.hpp"
#include "processes/geolocation/target_messages.hpp"
#include "processes/in_process_stack.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/files/log.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {
namespace {

constexpr int64_t kPathStep_us = 100'000;  // a path needs no more points

class TargetRecorder {
 public:
  explicit TargetRecorder(const Channels& channels) : channels_(channels) {}

  /// Of one event of the log; `computed`: TARGETS are computed, and those of the log are passed over.
  void note(const LogEvent& event, bool computed) {
    if (event.channel == channels_.pose) read<pose_t>(event, [&](const pose_t& m) { add(m); });
    if (event.channel == channels_.targets && !computed)
      read<targets_t>(event, [&](const targets_t& m) { add(m); });
    detections_ += event.channel == channels_.detections ? 1 : 0;
    poses_ += event.channel == channels_.pose ? 1 : 0;
  }
  void add(const targets_t& message) {
    ++flight_.frames;
    targets_ += message.n;
    last_status_ = message.status;
    if (message.has_global == 0) return;
    for (const target_t& target : message.targets) addPlace(message.utime, target);
  }
  /// Throws InputError where there is nothing to export.
  RecordedFlight finish(const std::filesystem::path& log, bool computed) {
    const auto fail = [&](const std::string& what) { throw InputError(log, what); };
    if (computed && detections_ == 0) fail("has no " + channels_.detections + " to place");
    if (computed && poses_ == 0)
      fail("has no " + channels_.pose + " to place " + channels_.detections + " by");
    if (flight_.frames == 0)
      fail("has no " + channels_.targets + "; with --config FILE they are computed from " +
           channels_.detections + " and " + channels_.pose);
    if (targets_ == 0)
      fail(fmt::format("has no target in {} frames (status {} of the last)", flight_.frames,
                       static_cast<int>(last_status_)));
    if (flight_.targets.empty())
      fail("its targets have no place on WGS-84: " + channels_.pose + " had no fix");
    return std::move(flight_);
  }

 private:
  template <typename Message, typename Handler>
  void read(const LogEvent& event, const Handler& handler) {
    Message message;
    if (decodePlausible(event.data, message)) {
      handler(message);
    } else {
      ++flight_.damaged;
    }
  }
  static bool isDue(const std::vector<RecordedPlace>& path, int64_t utime) {
    return path.empty() || utime - path.back().utime >= kPathStep_us || utime < path.back().utime;
  }
  void add(const pose_t& m) {
    if (m.has_global == 0 || !isDue(flight_.vehicle, m.utime)) return;
    flight_.vehicle.push_back({m.utime, m.latitude, m.longitude, m.altitude});
  }
  void addPlace(int64_t utime, const target_t& m) {
    RecordedTarget& target = flight_.targets[m.id];
    target.state = stateName(m.state);
    target.speed_m_s = std::hypot(m.velocity[0], m.velocity[1]);
    target.course_deg = std::fmod(std::atan2(m.velocity[0], m.velocity[1]) / kDegree + 360, 360);
    target.width_m = m.size[0];
    target.height_m = m.size[1];
    if (!isDue(target.places, utime)) return;
    target.places.push_back({utime, m.latitude, m.longitude, 0});
    target.sigmas_m.push_back(std::sqrt(m.position_covariance[0] + m.position_covariance[3]));
  }

  Channels channels_;
  RecordedFlight flight_;
  int64_t targets_ = 0;
  int64_t detections_ = 0;
  int64_t poses_ = 0;
  int8_t last_status_ = 0;
};

/// redbee-geolocation on what the log holds.
class GeolocationReplay {
 public:
  GeolocationReplay(const Configuration& configuration, TargetRecorder& recorder)
      : bus_(makeLcmBus("memq://")),
        subscription_(bus_->subscribe<targets_t>(configuration.channels.targets, kListenerQueue,
                                                 [&recorder](const targets_t& m) { recorder.add(m); })),
        channels_(configuration.channels),
        stack_(*bus_, configuration.channels.health, nodeOf(*bus_, configuration)) {}

  void play(const LogEvent& event) {
    if (!isInput(event.channel)) return;
    bus_->publish(event.channel, event.data);
    stack_.settle();
  }
  void finish() { stack_.finish(); }

 private:
  static Nodes nodeOf(Bus& bus, const Configuration& configuration) {
    Nodes nodes;
    nodes.push_back(std::make_unique<GeolocationNode>(bus, configuration));
    return nodes;
  }
  bool isInput(const std::string& channel) const {
    return channel == channels_.detections || channel == channels_.pose || channel == channels_.gimbal ||
           channel == channels_.altimeter || channel == channels_.lens;
  }

  std::unique_ptr<Bus> bus_;
  Subscription subscription_;
  Channels channels_;
  InProcessStack stack_;
};

}  // namespace

RecordedFlight readTargets(const std::filesystem::path& log,
                           const std::optional<std::filesystem::path>& configuration_file) {
  Configuration configuration;
  if (configuration_file)
    configuration = loadConfiguration(*configuration_file, {"", {"geolocation.enabled=true"}});
  LogReader reader(log);
  TargetRecorder recorder(configuration.channels);
  std::optional<GeolocationReplay> replay;
  if (configuration_file) replay.emplace(configuration, recorder);
  while (const auto event = reader.next()) {
    recorder.note(*event, configuration_file.has_value());
    if (replay) replay->play(*event);
  }
  if (replay) replay->finish();
  RecordedFlight flight = recorder.finish(log, configuration_file.has_value());
  flight.damage_report = reader.damageReport();
  return flight;
}

}  // namespace redbee
