// autopilot_observer [--lcm-url URL]: prints what redbee-autopilot publishes, a line a message, until
// SIGTERM. For tests/integration.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "processes/common_options.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/clock_offset_t.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/node.hpp"
#include "redbee/pose_t.hpp"
#include "redbee/process_health_t.hpp"

namespace redbee::test {
namespace {

constexpr int kQueue = 4000;

void print(const ins_t& m) {
  std::printf("IMU,%lld,%lld,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", static_cast<long long>(m.utime),
              static_cast<long long>(m.device_time), m.gyro[0], m.gyro[1], m.gyro[2], m.accel[0], m.accel[1],
              m.accel[2]);
}
void print(const altimeter_t& m) {
  std::printf("ALTIMETER,%lld,%.9g,%.9g\n", static_cast<long long>(m.utime), m.height, m.sigma);
}
void print(const pose_t& m) {
  std::printf("POSE,%lld,%.9g,%.9g,%.9g,%.9g,%d,%.12g,%.12g,%.9g\n", static_cast<long long>(m.utime),
              m.quat[0], m.quat[1], m.quat[2], m.quat[3], m.has_global, m.latitude, m.longitude, m.altitude);
}
void print(const lens_t& m) {
  std::printf("LENS,%lld,%d,%d,%.9g,%d\n", static_cast<long long>(m.utime), m.has_zoom, m.has_focal_length,
              m.focal_length, m.width);
}
void print(const clock_offset_t& m) {
  std::printf("CLOCK,%lld,%lld,%.9g,%.9g,%.9g\n", static_cast<long long>(m.utime),
              static_cast<long long>(m.offset), m.drift, m.sigma, m.round_trip);
}
void print(const process_health_t& m) {
  std::printf("HEALTH,%d,%lld,%lld,%s\n", m.state, static_cast<long long>(m.lost),
              static_cast<long long>(m.damaged), m.message.c_str());
}

void observe(const std::string& url) {
  const auto bus = makeLcmBus(url);
  const Channels channels;
  std::vector<Subscription> subscriptions;
  const auto add = [&](const std::string& channel, auto type) {
    using Message = decltype(type);
    subscriptions.push_back(bus->subscribe<Message>(channel, kQueue, [](const Message& m) { print(m); }));
  };
  add(channels.imu, ins_t());
  add(channels.altimeter, altimeter_t());
  add(channels.pose, pose_t());
  add(channels.lens, lens_t());
  add(channels.autopilot_clock, clock_offset_t());
  add(channels.health, process_health_t());
  const std::atomic<bool>& stop = stopOnSignals();
  while (!stop) {
    bus->handle(std::chrono::milliseconds(50));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace redbee::test

// A tool for us: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("prints what redbee-autopilot publishes", "autopilot_observer");
  std::string url;
  redbee::addLcmUrlOption(app, url);
  CLI11_PARSE(app, argc, argv);
  redbee::test::observe(url);
  return 0;
}
