// Runs the whole stack on memq:// over a simulated flight, whose messages a test may modify.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "processes/in_process_stack.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/geometry/row_major.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/visual_homography_t.hpp"
#include "tests/support/rendered_flight.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {

struct StackFlight {
  Configuration configuration;
  std::vector<SensorMessage> messages;  ///< in order of time
  std::vector<int64_t> frame_utimes;
  std::vector<Eigen::Matrix3d> homographies;
  std::vector<cv::Mat> masks;
};

/// Those of one time stay in their order.
inline void sortByTime(std::vector<SensorMessage>& messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const SensorMessage& a, const SensorMessage& b) { return a.utime < b.utime; });
}

/// The first `frames` of a scenario, with a configuration that has the true extrinsics.
inline StackFlight stackFlight(const simulation::Scenario& scenario, int frames) {
  const RenderedFlight rendered(scenario, frames);
  StackFlight flight;
  flight.configuration.camera = scenario.intrinsics;
  flight.configuration.inertial.extrinsics = scenario.extrinsics;
  flight.configuration.inertial.noise = scenario.imu.noise;
  flight.configuration.overlay_period_frames = 0;
  for (const ImuSample& sample : rendered.simulator().imu())
    flight.messages.push_back(encoded(message(sample)));
  flight.configuration.inertial.gimbal.enabled = scenario.gimbal.has_value();
  for (const MountSample& sample : rendered.simulator().gimbal())
    flight.messages.push_back(encoded(message(sample)));
  flight.configuration.inertial.lens.enabled = scenario.lens.has_value();
  for (const LensSample& sample : rendered.simulator().lens())
    flight.messages.push_back(encoded(message(sample, scenario.intrinsics.fx, scenario.intrinsics.width)));
  for (const AltitudeSample& sample : rendered.simulator().altimeter()) {
    flight.messages.push_back(encoded(message(sample)));
  }
  for (int k = 0; k < frames; ++k) {
    flight.messages.push_back(encoded(rawGreyMessage(rendered.utime(k), rendered.image(k).grey)));
    flight.frame_utimes.push_back(rendered.utime(k));
    flight.homographies.push_back(rendered.homography(k));
    flight.masks.push_back(rendered.image(k).mask);
  }
  sortByTime(flight.messages);
  return flight;
}

/// What the stack published, by frame time.
struct StackOutput {
  std::map<int64_t, inertial_homography_t> inertial;
  std::map<int64_t, visual_homography_t> visual;
  std::map<int64_t, fused_homography_t> fused;
  std::map<int64_t, foreground_t> foreground;
  std::map<int64_t, detections_t> detections;
  std::map<std::string, process_health_t> health;

  /// Stores the messages published on `bus` until the subscriptions end. This object must not be moved
  /// meanwhile.
  std::vector<Subscription> subscribe(Bus& bus) {
    const auto keep = [](auto& into) { return [&into](const auto& m) { into[m.utime] = m; }; };
    std::vector<Subscription> all;
    all.push_back(bus.subscribe<inertial_homography_t>("INERTIAL_HOMOGRAPHY", 64, keep(inertial)));
    all.push_back(bus.subscribe<visual_homography_t>("VISUAL_HOMOGRAPHY", 64, keep(visual)));
    all.push_back(bus.subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, keep(fused)));
    all.push_back(bus.subscribe<foreground_t>("FOREGROUND", 64, keep(foreground)));
    all.push_back(bus.subscribe<detections_t>("DETECTIONS", 64, keep(detections)));
    all.push_back(bus.subscribe<process_health_t>(
        "PROCESS_HEALTH", 64, [this](const process_health_t& m) { health[m.process] = m; }));
    return all;
  }
};

/// Runs one flight through a new stack, in the order of its messages.
class StackRun {
 public:
  explicit StackRun(const StackFlight& flight)
      : flight_(flight), own_bus_(makeLcmBus("memq://")), bus_(*own_bus_) {}
  StackRun(const StackFlight& flight, Bus& bus) : flight_(flight), bus_(bus) {}

  /// `before` is called with each message before it is published.
  StackOutput run(const std::function<void(const SensorMessage&)>& before = nullptr) {
    InProcessStack stack(bus_, flight_.configuration);
    return run(stack, before);
  }
  /// Of a stack that the test has made, on the bus of the constructor.
  StackOutput run(InProcessStack& stack, const std::function<void(const SensorMessage&)>& before = nullptr) {
    StackOutput output;
    const std::vector<Subscription> subscriptions = output.subscribe(bus_);
    for (const SensorMessage& sent : flight_.messages) {
      if (before) before(sent);
      bus_.publish(sent.channel, sent.data);
      stack.settle();
    }
    stack.finish();
    stack.publishHealth();
    return output;
  }

 private:
  const StackFlight& flight_;
  std::unique_ptr<Bus> own_bus_;
  Bus& bus_;
};

inline double groundError(const fused_homography_t& fused, const Eigen::Matrix3d& truth) {
  return meanTransferError(Eigen::Map<const RowMajor3d>(fused.step.H), truth, fused.width, fused.height);
}

}  // namespace redbee::test
