// make_flight: a simulated flight of a given image size, number of movers and length, as a log with its
// configuration beside it: for the curves of scripts/bench.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "processes/common_options.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/simulation/flight_simulator.hpp"
#include "redbee/simulation/scenarios.hpp"

namespace redbee::test {
namespace {

struct Options {
  int width = 640;
  int movers = 5;
  int frames = 32;
  std::filesystem::path log;
};

/// The same view with another number of pixels.
CameraIntrinsics scaled(CameraIntrinsics camera, int width) {
  const double scale = static_cast<double>(width) / camera.width;
  camera.height = width * camera.height / camera.width;
  camera.width = width;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx + 0.5) * scale - 0.5;
  camera.cy = (camera.cy + 0.5) * scale - 0.5;
  return camera;
}

/// Cars in rows of five across the view, which pass each other.
simulation::Scenario traffic(const Options& options) {
  constexpr int kRow = 5;
  simulation::Scenario scenario = simulation::groundOnly(7);
  scenario.intrinsics = scaled(scenario.intrinsics, options.width);
  scenario.frames = options.frames;
  for (int k = 0; k < options.movers; ++k) {
    const int row = k / kRow;
    const double x_m = 10 + 3 * row;
    const double y_m = 3.5 * (k % kRow - kRow / 2);
    const double speed = row % 2 == 0 ? 1.6 : -1.6;
    auto car = simulation::lyingPatch(simulation::PatchKind::kMover, x_m, y_m, M_PI / 2, 2.2, 1.2, 0.02,
                                      {simulation::TextureKind::kBody,
                                       11U + static_cast<unsigned>(k),
                                       0.02,
                                       k % 2 == 0 ? 50.0 : 180.0,
                                       45,
                                       {}});
    car.motion.velocity = {0, speed, 0};
    scenario.scene.patches.push_back(car);
  }
  return scenario;
}

void make(const Options& options) {
  const simulation::Scenario scenario = traffic(options);
  const simulation::FlightSimulator simulator(scenario);
  FlightMerger merger(options.log, ImportChannels(), simulator.imu(), simulator.altimeter());
  for (int k = 0; k < scenario.frames; ++k) {
    const simulation::SimulatedFrame frame = simulator.frame(k);
    merger.addFrame(jpegMessage(toUtime(frame.time), frame.image.grey, 90));
  }
  ImportSummary summary;
  merger.close(summary);
  Configuration configuration;
  configuration.vehicle = "traffic";
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  std::filesystem::path file = options.log;
  writeAtomically(file.replace_extension(".yaml"), emitYaml(configuration));
}

}  // namespace
}  // namespace redbee::test

// For benchmarks: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("makes a simulated flight");
  redbee::test::Options options;
  app.add_option("--width", options.width, "px; the height is three quarters")->check(CLI::Range(64, 4096));
  app.add_option("--movers", options.movers)->check(CLI::Range(0, 50));
  app.add_option("--frames", options.frames)->check(CLI::Range(2, 10000));
  redbee::addOutOption(app, options.log, "log to write; its configuration is written beside it");
  CLI11_PARSE(app, argc, argv);
  redbee::test::make(options);
  return 0;
}
