#include "processes/redbee/evaluate/hits_and_misses.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "processes/redbee/evaluate/flight_images.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

constexpr size_t kOfEach = 2;
const cv::Scalar kHit(70, 190, 60), kFalse(50, 50, 235), kMiss(235, 120, 30), kUntold(40, 210, 235);

double quality(const FrameOutcome& frame) {
  const double all = static_cast<double>(frame.hits + frame.false_alarms + frame.misses);
  if (all > 0) return static_cast<double>(frame.hits) / all;
  const ObjectCounts& objects = frame.objects;  // labels by boxes: no pixels are told
  return objects.present > 0 ? static_cast<double>(objects.found) /
                                   static_cast<double>(objects.present + objects.false_alarms)
                             : 1;
}

/// Of equally good ones the one with more at stake.
bool isWorse(const FrameOutcome& a, const FrameOutcome& b) {
  const double qa = quality(a), qb = quality(b);
  if (qa != qb) return qa < qb;
  return a.false_alarms + a.misses > b.false_alarms + b.misses;
}

bool isFarFrom(const std::vector<size_t>& chosen, size_t candidate, size_t distance) {
  return std::all_of(chosen.begin(), chosen.end(), [&](size_t other) {
    return (candidate > other ? candidate - other : other - candidate) >= distance;
  });
}

void tint(cv::Mat& image, const cv::Mat& where, const cv::Scalar& colour) {
  cv::Mat coloured;
  cv::addWeighted(image, 0.35, cv::Mat(image.size(), CV_8UC3, colour), 0.65, 0, coloured);
  coloured.copyTo(image, where);
}

void hatch(cv::Mat& image, const cv::Mat& where) {
  cv::Mat lines = cv::Mat::zeros(where.size(), CV_8U);
  for (int y = 0; y < lines.rows; ++y) {
    for (int x = (8 - y % 8) % 8; x < lines.cols; x += 8) lines.at<uint8_t>(y, x) = 255;
  }
  image.setTo(cv::Scalar(200, 200, 200), lines & where);
}

void writeJpeg(const std::filesystem::path& file, const cv::Mat& image) {
  constexpr int kWidth = 480;
  cv::Mat small = image;
  if (image.cols > kWidth) {
    cv::resize(image, small, {kWidth, image.rows * kWidth / image.cols}, 0, 0, cv::INTER_AREA);
  }
  std::vector<uint8_t> jpeg;
  cv::imencode(".jpg", small, jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  writeAtomically(file, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

}  // namespace

TellingFrames chooseTellingFrames(const std::vector<FrameOutcome>& frames, size_t of_each) {
  std::vector<size_t> order(frames.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return isWorse(frames[a], frames[b]); });
  const size_t distance = std::max<size_t>(1, frames.size() / 10);
  std::vector<size_t> taken;
  const auto take = [&](std::vector<size_t>& into, size_t candidate) {
    if (into.size() >= of_each || !isFarFrom(taken, candidate, distance)) return;
    into.push_back(candidate);
    taken.push_back(candidate);
  };
  TellingFrames chosen;
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    if (frames[*it].hits > 0 || frames[*it].objects.found > 0) take(chosen.best, *it);
  }
  for (const size_t candidate : order) take(chosen.worst, candidate);
  std::sort(chosen.best.begin(), chosen.best.end());
  std::sort(chosen.worst.begin(), chosen.worst.end());
  return chosen;
}

cv::Mat drawHitsAndMisses(const cv::Mat& grey, const cv::Mat& detected, const ClipTruth::Labels& truth) {
  cv::Mat image;
  cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  if (truth.mask.empty()) {
    tint(image, detected, kUntold);
    if (!truth.objects.ignored.empty()) hatch(image, truth.objects.ignored);
  } else {
    tint(image, detected & (truth.mask == 255), kHit);
    tint(image, detected & (truth.mask == 0), kFalse);
    tint(image, (detected == 0) & (truth.mask == 255), kMiss);
    hatch(image, (truth.mask != 255) & (truth.mask != 0));
  }
  for (const TruthObject& object : truth.objects.objects) {
    if (object.box.area() > 0) cv::rectangle(image, object.box, cv::Scalar(255, 255, 255), 1);
  }
  return image;
}

void writeHitsAndMisses(const EvaluateOptions& options, const ClipTruth& truth, const ClipMeasures& clip) {
  const auto folder = options.results / "images";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const TellingFrames telling = chooseTellingFrames(clip.frames, kOfEach);
  const auto times = imageTimes(options.log, options.camera_channel);
  std::map<int64_t, const char*> wanted;
  for (const size_t i : telling.best) wanted[clip.frames[i].utime] = "best";
  for (const size_t i : telling.worst) wanted[clip.frames[i].utime] = "worst";
  std::map<int64_t, ClipTruth::Frame> labelled;
  for (const ClipTruth::Frame& frame : truth.frames(times)) labelled[frame.utime] = frame;
  forEachImage(options.log, options.camera_channel, [&](const image_t& message) {
    const auto kind = wanted.find(message.utime);
    const auto grey = kind == wanted.end() ? std::nullopt : decodeGrey(message);
    if (!grey) return;
    const std::string stamp = std::to_string(message.utime);
    cv::Mat mask = cv::imread((options.results / "mask" / (stamp + ".png")).string(), cv::IMREAD_GRAYSCALE);
    if (mask.empty()) mask = cv::Mat::zeros(grey->size(), CV_8U);
    if (mask.size() != grey->size())
      throw InputError(options.results / "mask", "does not fit the flight's images");
    const auto labels = truth.read(labelled.at(message.utime), grey->size());
    writeJpeg(folder / (std::string(kind->second) + "-" + stamp + ".jpg"),
              drawHitsAndMisses(*grey, mask, labels));
  });
}

}  // namespace redbee
