// soak_trial: publishes the endless flight (tests/support/endless_flight.hpp) to a running stack for a given
// time, and checks by the health messages that neither memory nor processing time grows and no message is
// lost. Exit status 1 otherwise.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "processes/common_options.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/process_health_t.hpp"
#include "tests/support/live_player.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPoints = 10;
/// Between the second point and the last: by then every buffer has been filled once.
constexpr double kMostGrowth = 1.03;
constexpr int64_t kPage = int64_t{1} << 20;  ///< bytes: growth below it is no growth
constexpr double kMostDrift = 1.5;           ///< of the median work on a frame

using Point = std::map<std::string, process_health_t>;

struct Options {
  std::string url;
  double minutes = 60;
  double speed = 1;
};

void print(const Point& point, double minutes, int64_t frames) {
  std::printf("%6.1f min, %lld frames", minutes, static_cast<long long>(frames));
  for (const auto& [process, health] : point) {
    std::printf(" | %s %.1f MB, work %.1f ms, latency %.1f/%.1f ms, skipped %lld, lost %lld",
                process.c_str() + 7, static_cast<double>(health.resident) / 1e6, health.work_median,
                health.latency_median, health.latency_p99, static_cast<long long>(health.skipped),
                static_cast<long long>(health.lost));
  }
  std::printf("\n");
  std::fflush(stdout);
}

bool isSteady(const process_health_t& early, const process_health_t& late) {
  const int64_t growth = late.resident - early.resident;
  const bool grows = growth > kPage &&
                     static_cast<double>(late.resident) > kMostGrowth * static_cast<double>(early.resident);
  const bool drifts = late.work_median > kMostDrift * early.work_median + 1;
  if (grows) std::printf("GROWS: %s by %.1f MB\n", late.process.c_str(), static_cast<double>(growth) / 1e6);
  if (drifts) {
    std::printf("DRIFTS: %s from %.1f to %.1f ms\n", late.process.c_str(), early.work_median,
                late.work_median);
  }
  return !grows && !drifts;
}

bool isSteady(const std::vector<Point>& points) {
  const Point& early = points[1];
  const Point& late = points.back();
  bool steady = late.size() >= kStages.size();
  if (!steady) std::printf("only %zu processes published their health\n", late.size());
  for (const auto& [process, health] : late) {
    const auto before = early.find(process);
    steady = steady && before != early.end() && before->second.pid == health.pid &&
             isSteady(before->second, health);
  }
  return steady;
}

bool soak(const Options& options) {
  const auto bus = makeLcmBus(options.url);
  Point newest;
  const Subscription subscription = bus->subscribe<process_health_t>(
      "PROCESS_HEALTH", 64, [&](const process_health_t& m) { newest[m.process] = m; });
  const EndlessFlight flight;
  const double seconds = 60 * options.minutes;
  LivePlayer player(*bus, flight, (seconds + 5) * options.speed, options.speed);
  const auto start = Clock::now();
  std::vector<Point> points;
  while (points.size() < kPoints) {
    player.publishDue();
    bus->handle(std::chrono::milliseconds(1));
    const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    if (elapsed < seconds * static_cast<double>(points.size() + 1) / kPoints) continue;
    points.push_back(newest);
    print(newest, elapsed / 60, player.frames());
  }
  return isSteady(points);
}

}  // namespace
}  // namespace redbee::test

// For tests: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("flies into a running stack for long and checks its health");
  redbee::test::Options options;
  redbee::addLcmUrlOption(app, options.url);
  app.add_option("--minutes", options.minutes)->check(CLI::PositiveNumber);
  app.add_option("--speed", options.speed, "times the flight's own 24 frames a second")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  return redbee::test::soak(options) ? 0 : 1;
}
