// Processor time per frame of the whole stack and of rivals, decoding included, in one run, so that ratios
// are comparable. The bundled flight's images, from memory, on memq://. `work` is what the answer took,
// `publishing` what it took to make messages of it [ms a frame]; the time of an iteration holds both and the
// bus.
#include <benchmark/benchmark.h>

#include <memory>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "processes/redbee/detect/detect.hpp"
#include "redbee/files/log.hpp"

namespace {

using namespace redbee;

const std::vector<LogEvent>& flight() {
  static const std::vector<LogEvent> events = [] {
    cv::setNumThreads(1);
    LogReader log(REDBEE_SOURCE_DIR "/logs/park1.lcm");
    std::vector<LogEvent> all;
    while (const auto event = log.next()) all.push_back(*event);
    return all;
  }();
  return events;
}

Configuration configurationOf(const std::string& preset, const std::vector<std::string>& settings) {
  Configuration configuration = loadConfiguration(REDBEE_SOURCE_DIR "/config/park1.yaml", {preset, settings});
  configuration.overlay_period_frames = 0;
  return configuration;
}

/// One iteration is the whole flight.
void fly(benchmark::State& state, const Configuration& configuration) {
  CpuTime sum;
  int64_t frames = 0;
  for (auto _ : state) {
    const auto bus = makeLcmBus("memq://");
    InProcessStack stack = makeStack(*bus, configuration);
    for (const LogEvent& event : flight()) {
      bus->publish(event.channel, event.data);
      stack.settle();
      frames += event.channel == configuration.channels.camera ? 1 : 0;
    }
    stack.finish();
    for (const auto& [stage, time] : stack.cpu()) {
      sum.work += time.work;
      sum.publishing += time.publishing;
      state.counters[stage] += time.work;
    }
  }
  for (auto& [name, counter] : state.counters) counter.value /= static_cast<double>(frames);
  state.counters["work"] = sum.work / static_cast<double>(frames);
  state.counters["publishing"] = sum.publishing / static_cast<double>(frames);
}

void ours(benchmark::State& state, const std::string& preset, const std::vector<std::string>& settings) {
  fly(state, configurationOf(preset, settings));
}
void rival(benchmark::State& state, const std::string& name) {
  fly(state, configurationOf("default", {"detection.method=" + name}));
}

#define REDBEE_FLIGHT(function, name, ...) \
  BENCHMARK_CAPTURE(function, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)->Iterations(1)
using Settings = std::vector<std::string>;
REDBEE_FLIGHT(ours, default, "default", Settings{});
REDBEE_FLIGHT(ours, quarter_size_motion, "default", Settings{"detection.parallax.work_downscale=4"});
REDBEE_FLIGHT(ours, full_size_background, "default", Settings{"detection.appearance.downscale=1"});
REDBEE_FLIGHT(ours, preset_paper, "paper", Settings{});
REDBEE_FLIGHT(rival, mcd, "mcd");
REDBEE_FLIGHT(rival, aurora, "aurora");
REDBEE_FLIGHT(rival, meier, "meier");
REDBEE_FLIGHT(rival, homography_mog2, "homography-mog2");

}  // namespace
