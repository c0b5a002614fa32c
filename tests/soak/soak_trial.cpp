// soak_trial: publishes the endless flight (tests/support/endless_flight.hpp) to a running stack for a given
// time, and checks by the health messages that neither memory nor processing time grows and no message is
// lost. Exit status 1 otherwise.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "processes/common_options.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/process_health_t.hpp"
#include "tests/support/live_player.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPoints = 10;
/// Of resident memory over the second half, along a straight line through its points. In the first half the
/// allocator fills its arenas: where sizes vary, as the tracks of vision do, that takes tens of thousands of
/// frames, while what is allocated stays the same (tests/processes/memory_test.cpp). What grows with the
/// flight goes on, in both parts of that half; a queue that was once longer than before, on a machine that
/// was busy, is a step in one of them.
constexpr double kMostGrowth = 0.015;
constexpr double kLeastGrowth = 0.5e6;  ///< bytes: below it, it is no growth
constexpr double kMostDrift = 1.5;      ///< of the median work on a frame

using Point = std::map<std::string, process_health_t>;

struct Masks {
  int64_t answered = 0;  ///< frames with a FOREGROUND
  int64_t trusted = 0;   ///< of these, with status GOOD
};

struct Options {
  std::string url;
  double minutes = 60;
  double speed = 1;
};

void print(const Point& point, double minutes, int64_t frames, const Masks& masks) {
  std::printf("%6.1f min, %lld frames, %lld answered, %lld trusted", minutes, static_cast<long long>(frames),
              static_cast<long long>(masks.answered), static_cast<long long>(masks.trusted));
  for (const auto& [process, health] : point) {
    std::printf(" | %s %.1f MB, work %.1f ms, latency %.1f/%.1f ms, skipped %lld, lost %lld",
                process.c_str() + 7, static_cast<double>(health.resident) / 1e6, health.work_median,
                health.latency_median, health.latency_p99, static_cast<long long>(health.skipped),
                static_cast<long long>(health.lost));
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// bytes, from the first of the points to the last along the line of least squares.
double growthOver(std::vector<double>::const_iterator first, std::vector<double>::const_iterator last) {
  const double middle = 0.5 * static_cast<double>(last - first - 1);
  double by_time = 0;
  double by_square = 0;
  for (auto point = first; point != last; ++point) {
    const double since_middle = static_cast<double>(point - first) - middle;
    by_time += since_middle * *point;
    by_square += since_middle * since_middle;
  }
  return by_time / by_square * 2 * middle;
}

/// The least growth of two halves, as much as it makes over both.
double steadyGrowth(const std::vector<double>& resident) {
  const auto middle = resident.begin() + static_cast<std::ptrdiff_t>(resident.size() / 2);
  return 2 * std::min(growthOver(resident.begin(), middle + 1), growthOver(middle, resident.end()));
}

bool isSteady(const std::string& process, const std::vector<Point>& points) {
  std::vector<double> resident;
  for (size_t i = 1; i < points.size(); ++i) {
    const auto found = points[i].find(process);
    if (found == points[i].end() || found->second.pid != points.back().at(process).pid) {
      std::printf("ENDED or was not there: %s\n", process.c_str());
      return false;
    }
    if (i + 1 >= points.size() / 2) resident.push_back(static_cast<double>(found->second.resident));
  }
  const double growth = steadyGrowth(resident);
  const bool grows = growth > kLeastGrowth && growth > kMostGrowth * resident.front();
  if (grows) std::printf("GROWS: %s by %.1f MB over the second half\n", process.c_str(), growth / 1e6);
  const double early_ms = points[1].at(process).work_median;
  const double late_ms = points.back().at(process).work_median;
  const bool drifts = late_ms > kMostDrift * early_ms + 1;
  if (drifts) std::printf("DRIFTS: %s from %.1f to %.1f ms\n", process.c_str(), early_ms, late_ms);
  return !grows && !drifts;
}

bool isSteady(const std::vector<Point>& points) {
  bool steady = points.back().size() >= kStages.size();
  if (!steady) std::printf("only %zu processes published their health\n", points.back().size());
  for (const auto& [process, health] : points.back()) steady = isSteady(process, points) && steady;
  return steady;
}

bool soak(const Options& options) {
  const auto bus = makeLcmBus(options.url);
  Point newest;
  const Subscription subscription = bus->subscribe<process_health_t>(
      "PROCESS_HEALTH", 64, [&](const process_health_t& m) { newest[m.process] = m; });
  Masks masks;
  const Subscription foreground = bus->subscribe<foreground_t>("FOREGROUND", 64, [&](const foreground_t& m) {
    ++masks.answered;
    masks.trusted += m.status == foreground_t::GOOD ? 1 : 0;
  });
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
    print(newest, elapsed / 60, player.frames(), masks);
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
