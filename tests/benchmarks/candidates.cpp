// candidates: the candidates for objects of each frame of a recorded flight, with what they are judged by, as
// a table that scripts/train learns from.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/in_process_stack.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/detection/ground_detector.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"

namespace redbee::test {
namespace {

struct Options {
  std::filesystem::path log, configuration, out;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

void writeHeader(std::FILE* table) {
  std::fputs("#utime,x_px,y_px,width_px,height_px", table);
  for (const char* name : kRegionFeatureNames) std::fprintf(table, ",%s", name);
  std::fputc('\n', table);
}

void write(std::FILE* table, CameraTime time, double scale, const Candidate& candidate) {
  const cv::Rect& box = candidate.box;
  std::fprintf(table, "%lld,%g,%g,%g,%g", static_cast<long long>(time.time_since_epoch().count()),
               scale * box.x, scale * box.y, scale * box.width, scale * box.height);
  for (const float feature : candidate.features) std::fprintf(table, ",%.6g", static_cast<double>(feature));
  std::fputc('\n', table);
}

void run(const Options& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const File table(std::fopen(options.out.c_str(), "w"), &std::fclose);
  if (!table) throw InputError(options.out, "cannot be written");
  writeHeader(table.get());
  LogReader log(options.log);
  const auto bus = makeLcmBus("memq://");
  std::unique_ptr<Detector> detector = makeDetector(configuration.detection);
  dynamic_cast<GroundDetector&>(*detector).observeCandidates(
      [&](CameraTime time, cv::Size maps, const std::vector<Candidate>& candidates) {
        const double scale = static_cast<double>(configuration.camera.width) / maps.width;
        for (const Candidate& candidate : candidates) write(table.get(), time, scale, candidate);
      });
  Nodes nodes = motionNodes(*bus, configuration);
  nodes.push_back(std::make_unique<MotionSegmentationNode>(*bus, configuration, std::move(detector)));
  InProcessStack stack(*bus, configuration.channels.health, std::move(nodes));
  while (const auto event = log.next()) {
    if (!isInput(configuration.channels, event->channel)) continue;
    bus->publish(event->channel, event->data);
    stack.settle();
  }
  stack.finish();
}

}  // namespace
}  // namespace redbee::test

int main(int argc, char** argv) {
  CLI::App app("The candidates of each frame of a recorded flight, as a table for scripts/train.");
  redbee::test::Options options;
  app.add_option("--log", options.log)->required();
  app.add_option("--config", options.configuration)->required();
  app.add_option("--out", options.out)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    redbee::test::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "candidates: %s\n", error.what());
    return 2;
  }
  return 0;
}
