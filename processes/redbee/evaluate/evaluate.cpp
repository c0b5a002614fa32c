#include "processes/redbee/evaluate/evaluate.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "processes/redbee/evaluate/clip_truth.hpp"
#include "processes/redbee/evaluate/flight_images.hpp"
#include "processes/redbee/evaluate/measures_files.hpp"
#include "processes/redbee/evaluate/outcome_images.hpp"
#include "processes/redbee/pages/number.hpp"
#include "processes/redbee/pages/svg_plot.hpp"
#include "processes/redbee/pages/table.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/results/run_folder.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

ClipTruth truthOf(const EvaluateOptions& options) {
  return options.truth == "none" ? ClipTruth::nothingMoves() : ClipTruth(options.truth);
}

/// Of the probability maps. Throws InputError if the run has none, or no folder of masks.
std::vector<int64_t> mapTimes(const RunFolder& run) {
  std::vector<int64_t> times = run.times(RunMap::kProbability);
  if (times.empty()) throw InputError(run.path() / "probability", "holds no map <time in us>.png");
  run.times(RunMap::kMask);
  return times;
}

FrameOutcome outcome(int64_t utime, const cv::Mat1b& detected, const cv::Mat1b& truth) {
  FrameOutcome frame;
  frame.utime = utime;
  if (truth.empty()) return frame;
  frame.hits = cv::countNonZero((truth == 255) & detected);
  frame.misses = cv::countNonZero(truth == 255) - frame.hits;
  frame.false_alarms = cv::countNonZero((truth == 0) & detected);
  return frame;
}

/// `limit`: only the first frames of the recording; 0: all.
std::vector<ClipTruth::Frame> labelledFrames(const ClipTruth& truth, const std::vector<int64_t>& utimes,
                                             int64_t limit) {
  std::vector<ClipTruth::Frame> labelled = truth.frames(utimes);
  if (limit <= 0 || utimes.size() < static_cast<size_t>(limit)) return labelled;
  const int64_t last = utimes[static_cast<size_t>(limit) - 1];
  const auto beyond = [&](const ClipTruth::Frame& frame) { return frame.utime > last; };
  labelled.erase(std::remove_if(labelled.begin(), labelled.end(), beyond), labelled.end());
  return labelled;
}

std::vector<EvaluateOptions> clipsOf(const EvaluateOptions& options) {
  if (options.truth == "none" || ClipTruth::isIn(options.truth)) return {options};
  if (!fs::is_directory(options.truth))
    throw InputError(options.truth, fs::exists(options.truth) ? "is no folder; give the one that it is in"
                                                              : "no such folder");
  std::vector<EvaluateOptions> clips;
  for (const auto& entry : fs::directory_iterator(options.truth)) {
    const fs::path results = options.results / entry.path().filename();
    if (!ClipTruth::isIn(entry.path()) || !fs::is_directory(results)) continue;
    clips.push_back({entry.path(), results, {}, options.camera_channel, options.frames});
  }
  std::sort(clips.begin(), clips.end(), [](const auto& a, const auto& b) { return a.truth < b.truth; });
  if (clips.empty())
    throw InputError(options.truth, "no ground-truth masks for any folder in " + options.results.string());
  return clips;
}

std::vector<Cell> rowOf(const ClipMeasures& clip) {
  const ObjectMeasures& objects = clip.objects;
  std::vector<Cell> row{clip.name, std::to_string(objects.frames())};
  if (clip.pixels.movingPixels() > 0) {
    row.insert(row.end(), {fixed(clip.pixels.errorAtHalfRecall(), 3), fixed(clip.pixels.bestF1(), 3)});
  } else {
    row.insert(row.end(), 2, "-");  // as where boxes are all the truth
  }
  if (clip.has_movers) {
    row.insert(row.end(), {std::to_string(objects.counts().present), fixed(100 * objects.recall(), 1)});
  } else {
    row.insert(row.end(), 2, "-");
  }
  row.insert(row.end(), {fixed(objects.falseAlarmsPerFrame(), 2), fixed(100 * objects.falseAreaFraction(), 3),
                         std::to_string(clip.truth_without_result)});
  return row;
}

void addMeans(Table& table, const std::vector<ClipMeasures>& clips) {
  double error = 0, f1 = 0;
  int count = 0;
  for (const ClipMeasures& clip : clips) {
    if (clip.pixels.movingPixels() == 0) continue;
    error += clip.pixels.errorAtHalfRecall();
    f1 += clip.pixels.bestF1();
    ++count;
  }
  if (count < 2) return;
  std::vector<Cell> row{"mean", "", fixed(error / count, 3), fixed(f1 / count, 3)};
  row.resize(table.columns.size(), "");
  table.rows.push_back(row);
}

}  // namespace

ClipMeasures measureClip(const EvaluateOptions& options) {
  const ClipTruth truth = truthOf(options);
  const RunFolder run(options.results);
  const std::vector<int64_t> times = mapTimes(run);
  const cv::Size size = run.read(RunMap::kProbability, times.front()).size();
  ClipMeasures clip;
  clip.name = fs::weakly_canonical(options.results).filename().string();
  clip.frames_limit = options.frames;
  std::optional<ClipTracks> tracks;
  if (fs::exists(options.results / "detections.csv")) tracks.emplace(run.detections());
  const auto labelled = labelledFrames(
      truth, options.log.empty() ? times : imageTimes(options.log, options.camera_channel), options.frames);
  for (const ClipTruth::Frame& frame : labelled) {
    if (!run.has(RunMap::kProbability, frame.utime)) ++clip.truth_without_result;
    const ClipTruth::Labels labels = truth.read(frame, size);
    const cv::Mat1b mask = run.readOrZeros(RunMap::kMask, frame.utime, size);
    if (!labels.mask.empty()) {
      clip.pixels.add(run.readOrZeros(RunMap::kProbability, frame.utime, size), labels.mask);
      clip.decided.add(mask, labels.mask);
      clip.regions.add(mask, labels.mask);
    }
    clip.frames.push_back(outcome(frame.utime, mask, labels.mask));
    clip.frames.back().objects = clip.objects.add(mask, labels.objects);
    if (tracks) tracks->add(frame.utime, labels.objects);
  }
  if (clip.truth_without_result == static_cast<int64_t>(labelled.size()))
    throw InputError(options.results / "probability", "holds no map of a labelled frame");
  if (tracks) clip.tracks = tracks->report();
  clip.has_movers = clip.pixels.movingPixels() > 0 || clip.objects.counts().present > 0;
  return clip;
}

void runEvaluate(const EvaluateOptions& options) {
  SvgPlot::checkInstalled();
  Table table;
  table.columns = {"clip",       "frames",  "Error@50%",          "best F1",
                   "objects",    "found %", "false alarms/frame", "false area %",
                   "without map"};
  std::vector<ClipMeasures> measured;
  for (const EvaluateOptions& clip : clipsOf(options)) {
    measured.push_back(measureClip(clip));
    table.rows.push_back(rowOf(measured.back()));
    if (!clip.log.empty()) {
      writeOutcomeImages({clip.log, clip.camera_channel, RunFolder(clip.results)}, truthOf(clip),
                         measured.back().frames);
    }
    writeMeasures(clip.results, measured.back());
  }
  addMeans(table, measured);
  std::fputs(asText(table).c_str(), stdout);
}

}  // namespace redbee
