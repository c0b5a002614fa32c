#include "processes/redbee/evaluate/outcome_images.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "processes/redbee/evaluate/flight_images.hpp"
#include "processes/redbee/pages/page.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/image_codec/jpeg.hpp"

namespace redbee {
namespace {

constexpr size_t kOfEach = 2;

struct Colour {
  cv::Scalar bgr;
  const char* html;
};
const Colour kHit{{70, 190, 60}, "#3cbe46"}, kFalseAlarm{{50, 50, 235}, "#eb3232"},
    kMiss{{235, 120, 30}, "#1e78eb"}, kUnlabelled{{40, 210, 235}, "#c9b000"};

double quality(const FrameOutcome& frame) {
  const double all = static_cast<double>(frame.hits + frame.false_alarms + frame.misses);
  if (all > 0) return static_cast<double>(frame.hits) / all;
  const ObjectCounts& objects = frame.objects;  // labelled by boxes: pixels are unknown
  return objects.present > 0 ? static_cast<double>(objects.found) /
                                   static_cast<double>(objects.present + objects.false_alarms)
                             : 1;
}

/// Among equally good frames, the one with more wrong pixels is worse.
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

void tint(cv::Mat3b& image, const cv::Mat1b& where, const cv::Scalar& colour) {
  cv::Mat3b coloured;
  cv::addWeighted(image, 0.35, cv::Mat(image.size(), CV_8UC3, colour), 0.65, 0, coloured);
  coloured.copyTo(image, where);
}

void hatch(cv::Mat3b& image, const cv::Mat1b& where) {
  cv::Mat1b lines = cv::Mat1b::zeros(where.size());
  for (int y = 0; y < lines.rows; ++y) {
    for (int x = (8 - y % 8) % 8; x < lines.cols; x += 8) lines(y, x) = 255;
  }
  image.setTo(cv::Scalar(200, 200, 200), lines & where);
}

void writeJpeg(const std::filesystem::path& file, const cv::Mat& image) {
  constexpr int kWidth = 480;
  cv::Mat small = image;
  if (image.cols > kWidth) {
    cv::resize(image, small, {kWidth, image.rows * kWidth / image.cols}, 0, 0, cv::INTER_AREA);
  }
  const std::vector<uint8_t> jpeg = encodeJpeg(small, 80);
  writeAtomically(file, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

}  // namespace

RepresentativeFrames chooseRepresentativeFrames(const std::vector<FrameOutcome>& frames, size_t of_each) {
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
  RepresentativeFrames chosen;
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    if (frames[*it].hits > 0 || frames[*it].objects.found > 0) take(chosen.best, *it);
  }
  for (const size_t candidate : order) take(chosen.worst, candidate);
  std::sort(chosen.best.begin(), chosen.best.end());
  std::sort(chosen.worst.begin(), chosen.worst.end());
  return chosen;
}

cv::Mat3b drawOutcome(const cv::Mat1b& grey, const cv::Mat1b& detected, const ClipTruth::Labels& truth) {
  cv::Mat3b image;
  cv::cvtColor(grey, image, cv::COLOR_GRAY2BGR);
  if (truth.mask.empty()) {
    tint(image, detected, kUnlabelled.bgr);
    if (!truth.objects.ignored.empty()) hatch(image, truth.objects.ignored);
  } else {
    tint(image, cv::Mat1b(detected & (truth.mask == 255)), kHit.bgr);
    tint(image, cv::Mat1b(detected & (truth.mask == 0)), kFalseAlarm.bgr);
    tint(image, cv::Mat1b((detected == 0) & (truth.mask == 255)), kMiss.bgr);
    hatch(image, cv::Mat1b((truth.mask != 255) & (truth.mask != 0)));
  }
  for (const TruthObject& object : truth.objects.objects) {
    if (object.box.area() > 0) cv::rectangle(image, object.box, cv::Scalar(255, 255, 255), 1);
  }
  return image;
}

std::string outcomeLegend() {
  return "<p>" + legendEntry(kHit.html, "hit") + ", " + legendEntry(kFalseAlarm.html, "false alarm") + ", " +
         legendEntry(kMiss.html, "miss") + ", " +
         legendEntry(kUnlabelled.html, "detection where only boxes are labelled") +
         "; hatched: truth unknown. By the mask that the method decided on.</p>";
}

void writeOutcomeImages(const EvaluatedRun& run, const ClipTruth& truth,
                        const std::vector<FrameOutcome>& frames) {
  const auto folder = run.results.path() / "images";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const RepresentativeFrames chosen = chooseRepresentativeFrames(frames, kOfEach);
  std::map<int64_t, const char*> kinds;
  for (const size_t i : chosen.best) kinds[frames[i].utime] = "best";
  for (const size_t i : chosen.worst) kinds[frames[i].utime] = "worst";
  std::map<int64_t, ClipTruth::Frame> labelled;
  for (const ClipTruth::Frame& frame : truth.frames(imageTimes(run.log, run.camera_channel)))
    labelled[frame.utime] = frame;
  forEachImage(run.log, run.camera_channel, [&](const image_t& message) {
    const auto kind = kinds.find(message.utime);
    const auto grey = kind == kinds.end() ? std::nullopt : decodeGrey(message);
    if (!grey) return;
    const cv::Mat1b mask = run.results.readOrZeros(RunMap::kMask, message.utime, grey->size());
    const auto labels = truth.read(labelled.at(message.utime), grey->size());
    writeJpeg(folder / fmt::format("{}-{}.jpg", kind->second, message.utime),
              drawOutcome(*grey, mask, labels));
  });
}

}  // namespace redbee
