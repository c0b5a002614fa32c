// redbee try: from any recording to something to look at.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "processes/common_options.hpp"
#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/commands/importer_options.hpp"
#include "processes/redbee/commands/program_beside.hpp"
#include "processes/redbee/detect/detect.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/evaluate/report.hpp"
#include "processes/redbee/rosbag/rosbag_program.hpp"
#include "processes/redbee/vehicle/import_flight.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/recognise.hpp"
#include "redbee/importers/ros/import_ros.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

struct TryOptions {
  ImportOptions recording;
  fs::path configuration;  ///< empty: what the import writes
  fs::path out;            ///< empty: out/ and the recording's name
  const CLI::App* command = nullptr;
};

/// What any importer takes.
constexpr ImporterTakes kEverything{true, true, true, true, false, true, true};

/// A folder and those above it; what is still empty in the end is taken away again.
class OutFolder {
 public:
  explicit OutFolder(const fs::path& folder) {
    for (fs::path part = folder; !part.empty() && !fs::exists(part); part = part.parent_path())
      created_.push_back(part);
    fs::create_directories(folder);
  }
  ~OutFolder() {
    std::error_code not_empty;
    for (const fs::path& folder : created_) fs::remove(folder, not_empty);
  }
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  std::vector<fs::path> created_;  ///< the innermost first
};

Importer importerNamed(const std::string& name) {
  if (name == kRosbagName) return rosImporter(kRosbagName, kRosbagDescription, "F.bag", nullptr);
  const auto& all = importers();
  return *std::find_if(all.begin(), all.end(),
                       [&](const Importer& importer) { return importer.name == name; });
}

/// Of the importers' options, those that were given, as words of a command line. Throws InputError for one
/// that `takes` has not; `kind`: "import video", ...
std::vector<std::string> givenOptions(const TryOptions& options, const std::optional<ImporterTakes>& takes,
                                      const std::string& kind) {
  CLI::App all, taken;
  ImportOptions unused;
  addImporterOptions(all, unused, kEverything);
  if (takes) addImporterOptions(taken, unused, *takes);
  std::vector<std::string> words;
  for (const CLI::Option* option : options.command->get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || all.get_option_no_throw(name) == nullptr) continue;
    if (taken.get_option_no_throw(name) == nullptr)
      throw InputError(options.recording.source, kind + " takes no " + name);
    words.push_back(name);
    if (option->get_items_expected_max() > 0) words.push_back(option->as<std::string>());
  }
  return words;
}

/// The log and its configuration, of a recording that is a log.
std::pair<fs::path, fs::path> flightOfLog(const TryOptions& options) {
  const fs::path& source = options.recording.source;
  givenOptions(options, std::nullopt, "is a log, which is not imported: it");
  fs::path beside = source;
  beside.replace_extension(".yaml");
  const fs::path configuration = options.configuration.empty() ? beside : options.configuration;
  if (!fs::exists(configuration))
    throw InputError(source, "is a log: give its vehicle's configuration with --config");
  return {source, configuration};
}

/// The log and its configuration; imports if need be.
std::pair<fs::path, fs::path> flightOf(const TryOptions& options) {
  const fs::path& source = options.recording.source;
  const std::string found = recogniseRecording(source);
  if (found.empty()) return flightOfLog(options);
  if (options.recording.imu && (found == "mcap" || found == kRosbagName))
    throw InputError(source, "has an IMU of its own: leave --imu out, or choose with --imu-topic");
  // A table of its own replaces the motion track.
  const Importer importer = importerNamed(options.recording.imu ? "video" : found);
  std::vector<std::string> given = givenOptions(options, importer.takes, "import " + importer.name);
  const fs::path log = options.out / "flight.lcm";
  const bool has_configuration = !options.configuration.empty();
  if (found == kRosbagName) {
    given.insert(given.begin(), {source.string(), "--out", log.string()});
    runProgramBeside(kRosbagProgram, kRosbagName, given, kRosbagMissing);
    return {log, has_configuration ? options.configuration : options.out / "flight.yaml"};
  }
  ImportOptions recording = options.recording;
  recording.log = log;
  if (options.command->count("--width") == 0) recording.width = importer.defaults.width;
  recording.jpeg_quality = importer.defaults.jpeg_quality;
  const ImportedFlight flight = importFlight(importer, recording);
  printFlight(flight, log);
  return {log, has_configuration ? options.configuration : flight.configuration};
}

void runTry(TryOptions options) {
  const fs::path source = options.recording.source.lexically_normal();
  if (options.out.empty())
    options.out = fs::path("out") / (source.has_stem() ? source.stem() : source.parent_path().stem());
  if (!options.configuration.empty())
    loadConfiguration(options.configuration);  // before the import takes its time
  const OutFolder folder(options.out);
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
      options->command = &command;
      command
          .add_option("recording", options->recording.source,
                      "video, folder of images, EuRoC folder, MCAP, ROS 1 bag, or LCM log")
          ->required();
      addImporterOptions(command, options->recording, kEverything);
      command.add_option("--config", options->configuration,
                         "configuration of the vehicle (as the recording describes it)");
      addOutOption(command, options->out, "folder for everything (out/ and the recording's name)")
          ->required(false);
      command.callback([options] { runTry(*options); });
    });

}  // namespace
}  // namespace redbee
