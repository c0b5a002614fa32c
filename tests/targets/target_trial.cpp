// target_trial log FILE: the flight of tests/support/target_flight.hpp as a log, 15 s, with TARGETS.
// target_trial inputs FILE: the same without TARGETS.
// target_trial live SECONDS [--walks SECONDS] [--lcm-url URL]: the same in real time, and what is published
// about it: a line for each of TARGETS and PROCESS_HEALTH; at SIGUSR1 the walker stands, at SIGUSR2 POSE
// comes no more. For tests/integration.
#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "processes/common_options.hpp"
#include "processes/geolocation/node.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/files/log.hpp"
#include "redbee/node/host_clock.hpp"
#include "redbee/process_health_t.hpp"
#include "redbee/targets_t.hpp"
#include "tests/support/target_flight.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kShift_us = 20'000;

void writeLog(const std::string& file, bool has_targets) {
  const TargetFlight flight;
  const int64_t start_us = 1'000'000'000;
  LogWriter log(file);
  const auto bus = makeLcmBus("memq://");
  GeolocationNode node(*bus, TargetFlight::configuration());
  const Subscription subscription = bus->subscribe<targets_t>("TARGETS", 64, [&](const targets_t& m) {
    if (has_targets) log.write("TARGETS", m);
  });
  const auto write = [&](const std::string& channel, const auto& message) {
    log.write(channel, message);
    bus->publish(channel, message);
  };
  for (int k = 0; k < 15 * TargetFlight::kRate_hz; ++k) {
    const double t = k / TargetFlight::kRate_hz;
    const int64_t utime = start_us + std::llround(t * 1e6);
    write("POSE", TargetFlight::pose(utime + kShift_us, t));
    write("ALTIMETER", TargetFlight::altimeter(utime + kShift_us));
    write("DETECTIONS", flight.detections(utime, t, k));
    do {
      while (bus->handle(std::chrono::milliseconds(0))) {
      }
    } while (node.processNext());
  }
  log.close();
}

void print(const targets_t& m, int64_t start_us, const TargetFlight& flight) {
  const double t = static_cast<double>(m.utime - start_us) * 1e-6;
  for (const target_t& each : m.targets) {
    std::printf("TARGET,%.3f,%d,%d,%d,%.17g,%.17g,%.3f\n", t, m.status, each.id, each.state, each.latitude,
                each.longitude, flight.missOf(each.latitude, each.longitude, t));
  }
  if (m.targets.empty()) std::printf("NONE,%.3f,%d\n", t, m.status);
}

volatile std::sig_atomic_t stands = 0;
volatile std::sig_atomic_t is_without_pose = 0;

void flyLive(double seconds, double walks_s, const std::string& url) {
  TargetFlight flight;
  flight.walks_s = walks_s;
  flight.reported_s = walks_s + 2;
  std::signal(SIGUSR1, [](int) { stands = 1; });
  std::signal(SIGUSR2, [](int) { is_without_pose = 1; });
  const auto bus = makeLcmBus(url);
  const int64_t start_us = hostNanoseconds() / 1000;
  const Subscription targets =
      bus->subscribe<targets_t>("TARGETS", 1000, [&](const targets_t& m) { print(m, start_us, flight); });
  const Subscription health =
      bus->subscribe<process_health_t>("PROCESS_HEALTH", 1000, [](const process_health_t& m) {
        std::printf("HEALTH,%s,%d,%s\n", m.process.c_str(), m.state, m.message.c_str());
      });
  for (int k = 0; k < seconds * TargetFlight::kRate_hz; ++k) {
    const double t = k / TargetFlight::kRate_hz;
    const int64_t utime = start_us + std::llround(t * 1e6);
    if (stands != 0 && t < flight.walks_s) {
      flight.walks_s = t;
      flight.reported_s = t + 2;
    }
    while (hostNanoseconds() / 1000 < utime + kShift_us) bus->handle(std::chrono::milliseconds(5));
    if (is_without_pose == 0) bus->publish("POSE", TargetFlight::pose(utime + kShift_us, t));
    bus->publish("ALTIMETER", TargetFlight::altimeter(utime + kShift_us));
    bus->publish("DETECTIONS", flight.detections(utime, t, k));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace redbee::test

// A tool for us: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("a simulated flight of POSE and DETECTIONS", "target_trial");
  std::string file, url;
  double seconds = 10, walks_s = 1e9;
  app.require_subcommand(1);
  auto* log = app.add_subcommand("log");
  log->add_option("file", file)->required();
  auto* inputs = app.add_subcommand("inputs");
  inputs->add_option("file", file)->required();
  auto* live = app.add_subcommand("live");
  live->add_option("seconds", seconds)->required();
  live->add_option("--walks", walks_s);
  redbee::addLcmUrlOption(*live, url);
  CLI11_PARSE(app, argc, argv);
  if (log->parsed() || inputs->parsed()) redbee::test::writeLog(file, log->parsed());
  if (live->parsed()) redbee::test::flyLive(seconds, walks_s, url);
  return 0;
}
