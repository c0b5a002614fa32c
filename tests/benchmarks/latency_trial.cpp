// latency_trial: plays a recorded flight into a running stack, and prints how long after an image its
// DETECTIONS arrived: share of images answered, median, 99th percentile, longest [ms].
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "processes/common_options.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/files/log.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

struct Options {
  std::string url;
  std::filesystem::path log;
  double rate_hz = 24;
  double fps = 24;  ///< of the flight
};

/// The time inside of a message: behind the hash of its type, big-endian.
int64_t utimeOf(const std::vector<uint8_t>& data) {
  constexpr size_t kHash = 8;
  uint64_t utime = 0;
  for (size_t k = kHash; k < 2 * kHash; ++k) utime = utime << 8U | data.at(k);
  return static_cast<int64_t>(utime);
}

class Trial {
 public:
  Trial(Bus& bus, const Options& options) : bus_(bus), options_(options) {
    const Configuration configuration;
    camera_ = configuration.channels.camera;
    subscription_ = bus.subscribe<detections_t>(configuration.channels.detections, kListenerQueue,
                                                [this](const detections_t& m) {
                                                  const auto shown = shown_.find(m.utime);
                                                  if (shown != shown_.end())
                                                    answered_.emplace(m.utime, Clock::now() - shown->second);
                                                });
  }

  void fly() {
    LogReader log(options_.log);
    const auto start = Clock::now();
    std::optional<int64_t> first;
    while (const auto event = log.next()) {
      if (!first) first = event->utime;
      const double flown_us = static_cast<double>(event->utime - *first) * options_.fps / options_.rate_hz;
      const auto due = start + std::chrono::microseconds(static_cast<int64_t>(flown_us));
      while (Clock::now() < due) bus_.handle(std::chrono::milliseconds(1));
      if (event->channel == camera_) shown_[utimeOf(event->data)] = Clock::now();
      bus_.publish(event->channel, event->data);
    }
    const auto end = Clock::now() + std::chrono::seconds(2);
    while (Clock::now() < end) bus_.handle(std::chrono::milliseconds(1));
  }

  bool print() const {
    std::vector<double> latencies_ms;
    for (const auto& [utime, latency] : answered_) latencies_ms.push_back(Milliseconds(latency).count());
    if (latencies_ms.empty()) {
      std::fprintf(stderr, "latency_trial: no image of %s was answered\n", options_.log.c_str());
      return false;
    }
    std::sort(latencies_ms.begin(), latencies_ms.end());
    const auto quantile = [&](double q) {
      return latencies_ms[static_cast<size_t>(q * static_cast<double>(latencies_ms.size() - 1) + 0.5)];
    };
    std::printf("%zu of %zu images answered, %.1f ms median, %.1f ms p99, %.1f ms longest\n",
                answered_.size(), shown_.size(), quantile(0.5), quantile(0.99), latencies_ms.back());
    return true;
  }

 private:
  Bus& bus_;
  Options options_;
  std::string camera_;
  std::map<int64_t, Clock::time_point> shown_;
  std::map<int64_t, Clock::duration> answered_;
  Subscription subscription_;
};

}  // namespace
}  // namespace redbee::test

// For benchmarks: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("plays a flight into a running stack and measures the latency of its answers");
  redbee::test::Options options;
  redbee::addLcmUrlOption(app, options.url);
  redbee::addLogOption(app, options.log);
  app.add_option("--rate", options.rate_hz, "images a second")->check(CLI::PositiveNumber);
  app.add_option("--fps", options.fps, "images a second of the flight as recorded")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  const auto bus = redbee::makeLcmBus(options.url);
  redbee::test::Trial trial(*bus, options);
  trial.fly();
  return trial.print() ? 0 : 1;
}
