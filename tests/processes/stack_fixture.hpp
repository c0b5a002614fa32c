// The whole stack on memq://, fed with a simulated flight that a test may disturb on its way in.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "processes/in_process_stack.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/fused_homography_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee::test {

/// One thing that reaches the bus.
struct Arrival {
  int64_t utime = 0;
  std::string channel;
  std::vector<uint8_t> data;
};

struct Flight {
  Configuration configuration;
  std::vector<Arrival> arrivals;  ///< in order of time
  std::vector<int64_t> frame_utimes;
  std::vector<Eigen::Matrix3d> homographies;
  std::vector<cv::Mat> masks;
};

inline Arrival arrivalOf(const image_t& m) { return {m.utime, "CAMERA", encodeMessage(m)}; }
inline Arrival arrivalOf(const ins_t& m) { return {m.utime, "IMU", encodeMessage(m)}; }
inline Arrival arrivalOf(const altimeter_t& m) { return {m.utime, "ALTIMETER", encodeMessage(m)}; }

/// The first `frames` of a scenario, its configuration with the true extrinsics.
inline Flight fly(simulation::Scenario scenario, int frames) {
  scenario.frames = frames;
  const simulation::FlightSimulator simulator(scenario);
  Flight flight;
  flight.configuration.camera = scenario.intrinsics;
  flight.configuration.inertial.extrinsics = scenario.extrinsics;
  flight.configuration.inertial.noise = scenario.imu.noise;
  flight.configuration.overlay_period_frames = 0;
  for (const ImuSample& sample : simulator.imu()) {
    ins_t message{};
    message.utime = toUtime(sample.time);
    for (int i = 0; i < 3; ++i) {
      message.gyro[i] = sample.gyro(i);
      message.accel[i] = sample.accel(i);
    }
    flight.arrivals.push_back(arrivalOf(message));
  }
  for (const AltitudeSample& sample : simulator.altimeter()) {
    flight.arrivals.push_back(arrivalOf(altimeter_t{toUtime(sample.time), sample.height_m, sample.sigma_m}));
  }
  for (int k = 0; k < frames; ++k) {
    const auto frame = simulator.frame(k);
    flight.arrivals.push_back(arrivalOf(rawGreyMessage(toUtime(frame.time), frame.image.grey)));
    flight.frame_utimes.push_back(toUtime(frame.time));
    flight.homographies.push_back(simulator.homography(k));
    flight.masks.push_back(frame.image.mask);
  }
  std::stable_sort(flight.arrivals.begin(), flight.arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.utime < b.utime; });
  return flight;
}

/// What the stack said, by frame time.
struct Said {
  std::map<int64_t, inertial_homography_t> inertial;
  std::map<int64_t, visual_homography_t> visual;
  std::map<int64_t, fused_homography_t> fused;
  std::map<int64_t, foreground_t> foreground;
  std::map<int64_t, detections_t> detections;
  std::map<std::string, process_health_t> health;
};

/// Runs the arrivals through a fresh stack on this bus, in the order given. `before` sees each on its way in.
inline Said run(const Flight& flight, Bus& bus, const std::function<void(const Arrival&)>& before) {
  Said said;
  const auto keep = [](auto& into) { return [&into](const auto& m) { into[m.utime] = m; }; };
  bus.subscribe<inertial_homography_t>("INERTIAL_HOMOGRAPHY", 64, keep(said.inertial), nullptr);
  bus.subscribe<visual_homography_t>("VISUAL_HOMOGRAPHY", 64, keep(said.visual), nullptr);
  bus.subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, keep(said.fused), nullptr);
  bus.subscribe<foreground_t>("FOREGROUND", 64, keep(said.foreground), nullptr);
  bus.subscribe<detections_t>("DETECTIONS", 64, keep(said.detections), nullptr);
  bus.subscribe<process_health_t>(
      "PROCESS_HEALTH", 64, [&said](const process_health_t& m) { said.health[m.process] = m; }, nullptr);
  InProcessStack stack(bus, flight.configuration);
  for (const Arrival& arrival : flight.arrivals) {
    if (before) before(arrival);
    bus.publish(arrival.channel, arrival.data);
    stack.settle();
  }
  stack.finish();
  stack.publishHealth();
  return said;
}

inline Said run(const Flight& flight) {
  const auto bus = makeLcmBus("memq://");
  return run(flight, *bus, nullptr);
}

inline double groundError(const fused_homography_t& fused, const Eigen::Matrix3d& truth) {
  return meanTransferError(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(fused.H), truth,
                           fused.width, fused.height);
}

}  // namespace redbee::test
