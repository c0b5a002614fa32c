#include "processes/redbee/evaluate/simulate_flight.hpp"

#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "redbee/bus/image.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/importers/flight_merger.hpp"
#include "redbee/results/png_file.hpp"
#include "redbee/simulation/landscapes.hpp"
#include "redbee/simulation/scenarios.hpp"

namespace redbee {
namespace {

using ScenarioMaker = simulation::Scenario (*)(unsigned seed);

const std::map<std::string, ScenarioMaker>& scenarios() {
  static const std::map<std::string, ScenarioMaker> makers = {
      {"ground_only", simulation::groundOnly},
      {"two_planes", simulation::twoPlanes},
      {"waving_water", simulation::wavingWater},
      {"calibration", simulation::calibrationFlight},
      {"walkers", simulation::walkers},
      {"brisk_walkers", simulation::briskWalkers},
      {"gimbal_walkers", simulation::gimbalWalkers},
      {"zoom_walkers", simulation::zoomWalkers},
      {"park", simulation::park},
      {"street", simulation::street},
      {"shore", simulation::shore},
  };
  return makers;
}

constexpr int kJpegQuality = 90;  // of colour images

/// Ground truth on disk, in the layout of a flight folder's labels.
class TruthFolder {
 public:
  explicit TruthFolder(const std::filesystem::path& folder) : folder_(folder) {
    if (folder_.empty()) return;
    std::filesystem::create_directories(folder_ / "mask");
    std::filesystem::create_directories(folder_ / "id");
    objects_ << "#timestamp [ns],frame,object_id,kind,state,visible_pixels,x_min,y_min,x_max,y_max\n";
    homographies_ << "#timestamp [ns],frame,H11,H12,H13,H21,H22,H23,H31,H32,H33 (pixels of frame k-1 -> "
                     "pixels of frame k)\n";
    homographies_.precision(12);
  }

  void add(int k, CameraTime time, const simulation::RenderedImage& image, const Eigen::Matrix3d& H) {
    if (folder_.empty()) return;
    const std::string stamp = std::to_string(toUtime(time) * 1000);
    writePng(folder_ / "mask" / (stamp + ".png"), image.mask);
    writePng(folder_ / "id" / (stamp + ".png"), image.id);
    addObjects(stamp + ',' + std::to_string(k), image);
    homographies_ << stamp << ',' << k;
    for (int i = 0; i < 9; ++i) homographies_ << ',' << H(i / 3, i % 3);
    homographies_ << '\n';
  }

  void close() const {
    if (folder_.empty()) return;
    writeAtomically(folder_ / "homography.csv", homographies_.str());
    writeAtomically(folder_ / "objects.csv", objects_.str());
  }

 private:
  void addObjects(const std::string& frame, const simulation::RenderedImage& image) {
    double movers = 0;
    cv::minMaxLoc(image.id, nullptr, &movers);
    for (int id = 1; id <= static_cast<int>(movers); ++id) {
      const cv::Mat1b pixels = image.id == id;
      const cv::Rect box = cv::boundingRect(pixels);
      if (box.empty()) continue;
      double state = 0;
      cv::minMaxLoc(image.mask, nullptr, &state, nullptr, nullptr, pixels);
      objects_ << frame << ',' << id << ",mover," << (state == simulation::kMaskMoving ? "moving" : "stopped")
               << ',' << cv::countNonZero(pixels) << ',' << box.x << ',' << box.y << ',' << box.br().x - 1
               << ',' << box.br().y - 1 << '\n';
    }
  }

  std::filesystem::path folder_;
  std::ostringstream homographies_, objects_;
};

Configuration configurationOf(const simulation::Scenario& scenario, const SimulateOptions& options) {
  Configuration configuration;
  configuration.vehicle = "simulated-" + options.scenario + "-" + std::to_string(options.seed);
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  configuration.inertial.gimbal.enabled = scenario.gimbal.has_value();
  configuration.inertial.lens.enabled = scenario.lens.has_value();
  return configuration;
}

}  // namespace

std::string scenarioNames() {
  std::string names;
  for (const auto& [name, maker] : scenarios()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

void runSimulate(const SimulateOptions& options) {
  const auto maker = scenarios().find(options.scenario);
  if (maker == scenarios().end()) {
    throw InputError("--scenario " + options.scenario + ": unknown; known are " + scenarioNames());
  }
  simulation::Scenario scenario = maker->second(options.seed);
  scenario = simulation::withRollingShutter(std::move(scenario), 1e-3 * options.readout_ms);
  scenario.frames = std::max(1, static_cast<int>(options.seconds * scenario.fps));
  const simulation::FlightSimulator simulator(scenario);

  std::filesystem::path configuration = options.log;
  configuration.replace_extension(".yaml");
  checkWritable(configuration);
  Progress progress("simulating " + options.scenario, "frames");
  FlightMerger merger(options.log, ImportChannels(), simulator.imu(), simulator.altimeter());
  merger.addMount(simulator.gimbal());
  for (const LensSample& sample : simulator.lens())
    merger.addLens({sample.time, sample.zoom * scenario.intrinsics.fx, scenario.intrinsics.width});
  TruthFolder truth(options.truth);
  for (int k = 0; k < scenario.frames; ++k) {
    const simulation::SimulatedFrame frame = simulator.frame(k);
    const cv::Mat3b& bgr = frame.image.bgr;
    merger.addFrame(bgr.empty() ? rawGreyMessage(toUtime(frame.time), frame.image.grey)
                                : jpegMessage(toUtime(frame.time), bgr, kJpegQuality));
    truth.add(k, frame.time, frame.image, simulator.homography(k));
    progress.update(k + 1, scenario.frames);
  }
  ImportSummary summary;
  merger.close(summary);
  truth.close();
  writeAtomically(configuration, "# The simulated drone, with its true extrinsics.\n" +
                                     emitYaml(configurationOf(scenario, options)));
  progress.finish();
  std::printf("%s: %d frames; %s: its configuration\n", options.log.c_str(), scenario.frames,
              configuration.c_str());
}

}  // namespace redbee
