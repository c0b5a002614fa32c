#include "processes/redbee/detect/detect.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "processes/motion_segmentation/node.hpp"
#include "processes/redbee/detect/collector.hpp"
#include "processes/redbee/detect/input_survey.hpp"
#include "processes/redbee/detect/process_usage.hpp"
#include "processes/warnings.hpp"
#include "redbee/configuration/configuration_value.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/detection/detector.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/files/progress.hpp"

namespace redbee {
namespace {

using Clock = std::chrono::steady_clock;

/// Delays events to the speed of the recording times `rate`.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate) {}

  void wait(int64_t utime) {
    if (rate_ <= 0) return;
    if (!started_) first_utime_ = utime;
    started_ = true;
    std::this_thread::sleep_until(start_ + std::chrono::microseconds(static_cast<int64_t>(
                                               static_cast<double>(utime - first_utime_) / rate_)));
  }

 private:
  double rate_;
  bool started_ = false;
  int64_t first_utime_ = 0;
  Clock::time_point start_ = Clock::now();
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Configuration configurationFor(const DetectOptions& options) {
  if (!contains(methodNames(), options.method)) {
    throw InputError("--method " + options.method + ": unknown; known are " + methodList());
  }
  ConfigurationOverrides overrides;
  if (contains(detectorNames(), options.method)) {
    overrides.settings.push_back("detection.method=" + options.method);
  } else if (contains(presetNames(), options.method)) {
    overrides.preset = options.method;
  }
  overrides.settings.insert(overrides.settings.end(), options.settings.begin(), options.settings.end());
  return loadConfiguration(options.configuration, overrides);
}

/// What the segmentation said last; may be empty.
std::string lastWord(const ResultCollector& collector) {
  const auto health = collector.health().find(programName(kMotionSegmentation));
  return health == collector.health().end() ? "" : health->second.message;
}

std::string withReason(const std::string& what, const std::string& reason) {
  return reason.empty() ? what : what + ": " + reason;
}

/// Of images that all were of no use, such as another camera's.
std::string reasonOfNoFrame(const ResultCollector& collector, const InputSurvey& survey) {
  const std::string text = "none of " + std::to_string(survey.images()) + " images can be used";
  const std::string fault = survey.faultOfFirstImage();
  return withReason(text, fault.empty() ? lastWord(collector) : fault);
}

void warnOf(const InputSurvey& survey, const LogReader& log) {
  printWarning(log.damageReport());
  printWarnings(survey.warnings());
}

}  // namespace

InProcessStack makeStack(Bus& bus, const Configuration& configuration) {
  if (makeDetector(configuration.detection)->needs().camera_motion) return {bus, configuration};
  Nodes nodes;
  nodes.push_back(std::make_unique<MotionSegmentationNode>(bus, configuration));
  return {bus, configuration.channels.health, std::move(nodes)};
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names{"redbee"};
  for (const std::string& preset : presetNames()) names.push_back(preset);
  for (const std::string& detector : detectorNames()) names.push_back(detector);
  return names;
}

std::string methodList() { return configuration::listOf(methodNames()); }

int64_t runDetect(const DetectOptions& options) {
  const Configuration configuration = configurationFor(options);
  LogReader log(options.log);
  const auto bus = makeLcmBus("memq://");
  ResultCollector collector(*bus, configuration.channels, options.out);
  InProcessStack stack = makeStack(*bus, configuration);
  Progress progress("detecting in " + options.log.filename().string(), "MB", options.quiet);
  Pace pace(options.rate);
  const auto start = Clock::now();
  InputSurvey survey(configuration);
  const auto enough = [&] { return options.frames > 0 && survey.images() >= options.frames; };
  while (const auto event = enough() ? std::nullopt : log.next()) {
    if (!isInput(configuration.channels, event->channel)) continue;
    pace.wait(event->utime);
    bus->publish(event->channel, event->data);
    stack.settle();
    survey.add(*event);
    progress.update(log.position() >> 20, log.size() >> 20);
  }
  if (survey.images() == 0) {
    throw InputError(options.log, "holds no message on " + configuration.channels.camera);
  }
  stack.finish();
  const double wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  stack.publishHealth();
  progress.finish();
  warnOf(survey, log);
  if (collector.framesWithImage() == 0) throw InputError(options.log, reasonOfNoFrame(collector, survey));
  ProcessUsage usage = processUsage();
  usage.stages = stack.cpu();
  collector.writeTables(wall_s, usage);
  if (collector.trustedFrames() == 0) {
    throw InputError(options.log,
                     withReason("none of " + std::to_string(collector.frames()) +
                                    " frames has a mask to trust (results in " + options.out.string() + ")",
                                lastWord(collector)));
  }
  return collector.frames();
}

}  // namespace redbee
