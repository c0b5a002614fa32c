// redbee try: from any recording to something to look at.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/commands/program_beside.hpp"
#include "processes/redbee/detect/detect.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/evaluate/report.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"
#include "processes/redbee/vehicle/import_flight.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/recognise.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct TryOptions {
  ImportOptions recording;
  fs::path configuration;  ///< empty: what the import writes
  fs::path out;            ///< empty: out/ and the recording's name
};

const Importer& importerNamed(const std::string& name) {
  const auto& all = importers();
  return *std::find_if(all.begin(), all.end(),
                       [&](const Importer& importer) { return importer.name == name; });
}

std::vector<std::string> rosbagArguments(const ImportOptions& options, const fs::path& log) {
  std::vector<std::string> arguments{options.source.string(), "--out", log.string()};
  const RosTopicChoice& topics = options.topics;
  for (const auto& [option, topic] : {std::pair{"--image-topic", topics.image},
                                      {"--imu-topic", topics.imu},
                                      {"--range-topic", topics.range},
                                      {"--camera-info-topic", topics.camera_info}}) {
    if (!topic.empty()) arguments.insert(arguments.end(), {option, topic});
  }
  return arguments;
}

/// The log and its configuration; imports if need be.
std::pair<fs::path, fs::path> flightOf(const TryOptions& options) {
  const fs::path& source = options.recording.source;
  // A table of its own replaces the motion track.
  const std::string found = recogniseRecording(source);
  if (options.recording.imu && (found == "mcap" || found == kRosbagName))
    throw InputError(source, "has an IMU of its own: leave --imu out, or choose with --imu-topic");
  const std::string kind = options.recording.imu && !found.empty() ? "video" : found;
  if (kind.empty()) {
    fs::path beside = source;
    beside.replace_extension(".yaml");
    const fs::path configuration = options.configuration.empty() ? beside : options.configuration;
    if (!fs::exists(configuration))
      throw InputError(source, "is a log: give its vehicle's configuration with --config");
    return {source, configuration};
  }
  const fs::path log = options.out / "flight.lcm";
  const bool has_configuration = !options.configuration.empty();
  if (kind == kRosbagName) {
    runProgramBeside(kRosbagProgram, kRosbagName, rosbagArguments(options.recording, log), kRosbagMissing);
    return {log, has_configuration ? options.configuration : options.out / "flight.yaml"};
  }
  ImportOptions recording = options.recording;
  recording.log = log;
  const ImportOptions& defaults = importerNamed(kind).defaults;
  recording.width = defaults.width;
  recording.jpeg_quality = defaults.jpeg_quality;
  const ImportedFlight flight = importFlight(importerNamed(kind), recording);
  printFlight(flight, log);
  return {log, has_configuration ? options.configuration : flight.configuration};
}

void runTry(TryOptions options) {
  const fs::path source = options.recording.source.lexically_normal();
  if (options.out.empty())
    options.out = fs::path("out") / (source.has_stem() ? source.stem() : source.parent_path().stem());
  fs::create_directories(options.out);
  const auto [log, configuration] = flightOf(options);
  DetectOptions detect;
  detect.log = log;
  detect.configuration = configuration;
  detect.out = options.out;
  runDetect(detect);
  renderOverlay({log, configuration, options.out, options.out / "overlay.mp4", {}});
  writeReport({log, configuration, options.out, {}, options.out / "report.html"});
  std::printf("look at %s and %s\n", (options.out / "overlay.mp4").c_str(),
              (options.out / "report.html").c_str());
}

const Command kTryCommand(
    CommandGroup::kFlights, "try", "import any recording, detect, and leave an overlay video and a report",
    [](CLI::App& command) {
      auto options = std::make_shared<TryOptions>();
      command
          .add_option("recording", options->recording.source,
                      "video, folder of images, EuRoC folder, MCAP, ROS 1 bag, or LCM log")
          ->required();
      command.add_option("--imu", options->recording.imu, "IMU samples, see import video");
      command
          .add_option("--fps", options->recording.fps,
                      "frames per second of a folder of images, or of a raw stream")
          ->check(CLI::PositiveNumber);
      addTopicOptions(command, options->recording.topics);
      command.add_option("--config", options->configuration,
                         "configuration of the vehicle (as the recording describes it)");
      addOutOption(command, options->out, "folder for everything (out/ and the recording's name)")
          ->required(false);
      command.callback([options] { runTry(*options); });
    });

}  // namespace
}  // namespace redbee
