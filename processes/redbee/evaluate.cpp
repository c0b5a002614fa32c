#include "processes/redbee/evaluate.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>

#include "flight/atomic_file.hpp"
#include "flight/input_error.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

/// PNGs by the time that their names tell [us]; `unit` of a name in nanoseconds is 1000.
std::map<int64_t, fs::path> picturesByTime(const fs::path& folder, int64_t unit) {
  if (!fs::is_directory(folder)) throw InputError(folder, "no such folder");
  std::map<int64_t, fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool numeric =
        !stem.empty() && stem.size() < 20 && std::all_of(stem.begin(), stem.end(), ::isdigit);
    if (entry.path().extension() == ".png" && numeric) {
      pictures[(std::stoll(stem) + unit / 2) / unit] = entry.path();
    }
  }
  return pictures;
}

cv::Mat readMap(const fs::path& file) {
  cv::Mat map = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (map.empty()) throw InputError(file, "not a readable picture");
  return map;
}

std::optional<fs::path> maskFolder(const fs::path& folder) {
  for (const fs::path& candidate : {folder / "labels" / "mask", folder / "mask"}) {
    if (fs::is_directory(candidate)) return candidate;
  }
  const auto is_picture = [](const fs::directory_entry& entry) { return entry.path().extension() == ".png"; };
  if (fs::is_directory(folder) &&
      std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), is_picture)) {
    return folder;
  }
  return std::nullopt;
}

void writeCurve(const fs::path& folder, const PixelMeasures& measures) {
  std::ostringstream csv;
  csv << "threshold,precision,recall\n";
  for (const OperatingPoint& point : measures.curve()) {
    csv << point.threshold << ',' << point.precision << ',' << point.recall << '\n';
  }
  writeAtomically(folder / "pr.csv", csv.str());
}

std::vector<std::pair<fs::path, fs::path>> clipsOf(const EvaluateOptions& options) {
  if (maskFolder(options.truth)) return {{options.truth, options.results}};
  if (!fs::is_directory(options.truth)) throw InputError(options.truth, "no such folder");
  std::vector<std::pair<fs::path, fs::path>> clips;
  for (const auto& entry : fs::directory_iterator(options.truth)) {
    const fs::path results = options.results / entry.path().filename();
    if (maskFolder(entry.path()) && fs::is_directory(results)) clips.emplace_back(entry.path(), results);
  }
  std::sort(clips.begin(), clips.end());
  if (clips.empty())
    throw InputError(options.truth, "holds no truth masks that " + options.results.string() + " answers");
  return clips;
}

}  // namespace

ClipMeasures measureClip(const fs::path& truth, const fs::path& results) {
  const auto masks_folder = maskFolder(truth);
  if (!masks_folder) throw InputError(truth, "holds no truth masks (<time in ns>.png)");
  const auto masks = picturesByTime(*masks_folder, 1000);
  const auto maps = picturesByTime(results / "probability", 1);
  ClipMeasures clip;
  clip.name = results.filename().string();
  int64_t answered = 0;
  for (const auto& [utime, mask_file] : masks) {
    const cv::Mat mask = readMap(mask_file);
    const auto map = maps.find(utime);
    cv::Mat probability = cv::Mat::zeros(mask.size(), CV_8U);
    if (map != maps.end()) {
      probability = readMap(map->second);
      ++answered;
    } else {
      ++clip.truth_without_result;
    }
    if (probability.size() != mask.size())
      throw InputError(map->second, "differs in size from " + mask_file.string());
    clip.pixels.add(probability, mask);
  }
  if (answered == 0) throw InputError(results / "probability", "holds no map of a labelled frame");
  return clip;
}

void runEvaluate(const EvaluateOptions& options) {
  double error_sum = 0;
  double f1_sum = 0;
  const auto clips = clipsOf(options);
  std::printf("%-16s %7s %10s %8s %8s\n", "clip", "frames", "Error@50%", "best F1", "no map");
  for (const auto& [truth, results] : clips) {
    const ClipMeasures clip = measureClip(truth, results);
    error_sum += clip.pixels.errorAtHalfRecall();
    f1_sum += clip.pixels.bestF1();
    writeCurve(results, clip.pixels);
    std::printf("%-16s %7lld %10.3f %8.3f %8lld\n", clip.name.c_str(),
                static_cast<long long>(clip.pixels.frames()), clip.pixels.errorAtHalfRecall(),
                clip.pixels.bestF1(), static_cast<long long>(clip.truth_without_result));
  }
  const auto count = static_cast<double>(clips.size());
  std::printf("%-16s %7s %10.3f %8.3f\n", "mean", "", error_sum / count, f1_sum / count);
}

}  // namespace redbee
