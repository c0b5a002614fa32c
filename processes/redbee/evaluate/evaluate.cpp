#include "processes/redbee/evaluate/evaluate.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/evaluate/clip_truth.hpp"
#include "processes/redbee/evaluate/flight_images.hpp"
#include "processes/redbee/evaluate/hits_and_misses.hpp"
#include "processes/redbee/evaluate/measures_files.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;
using MapFiles = std::map<int64_t, fs::path>;  // by time [us]

MapFiles mapsIn(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "no such folder");
  MapFiles maps;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool numeric = !stem.empty() && stem.size() < 20 &&
                         std::all_of(stem.begin(), stem.end(),
                                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    if (entry.path().extension() == ".png" && numeric) maps[std::stoll(stem)] = entry.path();
  }
  return maps;
}

cv::Mat readMap(const fs::path& file) {
  cv::Mat map = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (map.empty()) throw InputError(file, "not a readable image");
  return map;
}

cv::Mat mapAt(const MapFiles& maps, int64_t utime, cv::Size size) {
  const auto found = maps.find(utime);
  if (found == maps.end()) return cv::Mat::zeros(size, CV_8U);
  cv::Mat map = readMap(found->second);
  if (map.size() != size) throw InputError(found->second, "differs in size from the run's other maps");
  return map;
}

std::vector<int64_t> timesOf(const MapFiles& maps) {
  std::vector<int64_t> times;
  for (const auto& [utime, file] : maps) times.push_back(utime);
  return times;
}

ClipTruth truthOf(const EvaluateOptions& options) {
  return options.truth == "none" ? ClipTruth::nothingMoves() : ClipTruth(options.truth);
}

FrameOutcome outcome(int64_t utime, const cv::Mat& detected, const cv::Mat& truth) {
  FrameOutcome frame;
  frame.utime = utime;
  if (truth.empty()) return frame;
  frame.hits = cv::countNonZero((truth == 255) & detected);
  frame.misses = cv::countNonZero(truth == 255) - frame.hits;
  frame.false_alarms = cv::countNonZero((truth == 0) & detected);
  return frame;
}

/// `limit`: only the first so many frames of the recording; 0: all.
std::vector<ClipTruth::Frame> labelledFrames(const ClipTruth& truth, const std::vector<int64_t>& utimes,
                                             int64_t limit) {
  std::vector<ClipTruth::Frame> labelled = truth.frames(utimes);
  if (limit <= 0 || utimes.size() <= static_cast<size_t>(limit)) return labelled;
  const int64_t first_beyond = utimes[static_cast<size_t>(limit)];
  const auto beyond = [&](const ClipTruth::Frame& frame) { return frame.utime >= first_beyond; };
  labelled.erase(std::remove_if(labelled.begin(), labelled.end(), beyond), labelled.end());
  return labelled;
}

std::vector<EvaluateOptions> clipsOf(const EvaluateOptions& options) {
  if (options.truth == "none" || ClipTruth::isIn(options.truth)) return {options};
  if (!fs::is_directory(options.truth)) throw InputError(options.truth, "no such folder");
  std::vector<EvaluateOptions> clips;
  for (const auto& entry : fs::directory_iterator(options.truth)) {
    const fs::path results = options.results / entry.path().filename();
    if (!ClipTruth::isIn(entry.path()) || !fs::is_directory(results)) continue;
    clips.push_back({entry.path(), results, {}, options.camera_channel, options.frames});
  }
  std::sort(clips.begin(), clips.end(), [](const auto& a, const auto& b) { return a.truth < b.truth; });
  if (clips.empty())
    throw InputError(options.truth, "holds no truth masks that " + options.results.string() + " answers");
  return clips;
}

void printHeader() {
  std::printf("%-16s %7s %10s %8s %11s %7s %9s %11s %8s\n", "clip", "frames", "Error@50%", "best F1",
              "objects", "found", "false/fr.", "false area", "no map");
}

void print(const ClipMeasures& clip) {
  const ObjectMeasures& objects = clip.objects;
  std::printf("%-16s %7lld ", clip.name.c_str(), static_cast<long long>(objects.frames()));
  if (clip.has_movers) {
    std::printf("%10.3f %8.3f %11lld %6.1f%%", clip.pixels.errorAtHalfRecall(), clip.pixels.bestF1(),
                static_cast<long long>(objects.counts().present), 100 * objects.recall());
  } else {
    std::printf("%10s %8s %11s %7s", "-", "-", "-", "-");
  }
  std::printf(" %9.2f %10.3f%% %8lld\n", objects.falseAlarmsPerFrame(), 100 * objects.falseAreaFraction(),
              static_cast<long long>(clip.truth_without_result));
}

void printMeans(const std::vector<ClipMeasures>& clips) {
  double error = 0, f1 = 0;
  int count = 0;
  for (const ClipMeasures& clip : clips) {
    if (!clip.has_movers) continue;
    error += clip.pixels.errorAtHalfRecall();
    f1 += clip.pixels.bestF1();
    ++count;
  }
  if (count > 1) std::printf("%-16s %7s %10.3f %8.3f\n", "mean", "", error / count, f1 / count);
}

}  // namespace

ClipMeasures measureClip(const EvaluateOptions& options) {
  const ClipTruth truth = truthOf(options);
  const MapFiles maps = mapsIn(options.results / "probability");
  const MapFiles masks = mapsIn(options.results / "mask");
  if (maps.empty()) throw InputError(options.results / "probability", "holds no map <time in us>.png");
  const cv::Size size = readMap(maps.begin()->second).size();
  ClipMeasures clip;
  clip.name = fs::weakly_canonical(options.results).filename().string();
  clip.frames_limit = options.frames;
  const auto labelled = labelledFrames(
      truth, options.log.empty() ? timesOf(maps) : imageTimes(options.log, options.camera_channel),
      options.frames);
  for (const ClipTruth::Frame& frame : labelled) {
    if (maps.count(frame.utime) == 0) ++clip.truth_without_result;
    const ClipTruth::Labels labels = truth.read(frame, size);
    const cv::Mat mask = mapAt(masks, frame.utime, size);
    if (!labels.mask.empty()) {
      clip.pixels.add(mapAt(maps, frame.utime, size), labels.mask);
      clip.decided.add(mask, labels.mask);
    }
    clip.frames.push_back(outcome(frame.utime, mask, labels.mask));
    clip.frames.back().objects = clip.objects.add(mask, labels.objects);
  }
  if (clip.truth_without_result == static_cast<int64_t>(labelled.size()))
    throw InputError(options.results / "probability", "holds no map of a labelled frame");
  clip.has_movers = clip.pixels.movingPixels() > 0 || clip.objects.counts().present > 0;
  return clip;
}

void runEvaluate(const EvaluateOptions& options) {
  SvgPlot::checkInstalled();
  std::vector<ClipMeasures> measured;
  printHeader();
  for (const EvaluateOptions& clip : clipsOf(options)) {
    measured.push_back(measureClip(clip));
    print(measured.back());
    if (!clip.log.empty()) writeHitsAndMisses(clip, truthOf(clip), measured.back());
    writeMeasures(clip.results, measured.back());
  }
  printMeans(measured);
}

}  // namespace redbee
