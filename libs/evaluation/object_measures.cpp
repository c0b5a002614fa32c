#include "redbee/evaluation/object_measures.hpp"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/evaluation/truth_label.hpp"
#include "redbee/imaging/box_overlap.hpp"

namespace redbee {
namespace {

constexpr double kFoundFraction = 0.25;
constexpr double kFoundOverlap = 0.2;
constexpr double kBoxTolerancePx = 2;

struct Component {
  cv::Rect2d box;
  int64_t area = 0;
  int64_t ignored = 0;
  bool touches_object = false;
};

void check(const cv::Mat1b& detected, const ObjectTruth& truth) {
  const bool ids_fit = truth.ids.empty() || truth.ids.size() == detected.size();
  const bool ignored_fits = truth.ignored.empty() || truth.ignored.size() == detected.size();
  if (detected.empty() || !ids_fit || !ignored_fits)
    throw std::invalid_argument("countObjects: maps must be of one size");
}

std::vector<Component> componentsOf(const cv::Mat1b& detected, const ObjectTruth& truth) {
  cv::Mat1i labels, statistics;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(detected, labels, statistics, centroids, 8, CV_32S);
  std::vector<Component> components(static_cast<size_t>(count));
  for (int i = 1; i < count; ++i) {
    const int* row = statistics[i];
    components[static_cast<size_t>(i)].box = cv::Rect2d(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP],
                                                        row[cv::CC_STAT_WIDTH], row[cv::CC_STAT_HEIGHT]);
    components[static_cast<size_t>(i)].area = row[cv::CC_STAT_AREA];
  }
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      Component& component = components[static_cast<size_t>(labels(y, x))];
      if (!truth.ignored.empty() && truth.ignored(y, x) != 0) ++component.ignored;
      if (!truth.ids.empty() && truth.ids(y, x) != 0) component.touches_object = true;
    }
  }
  components.erase(components.begin());  // the background
  if (truth.ids.empty()) {
    for (Component& component : components) {
      component.touches_object =
          std::any_of(truth.objects.begin(), truth.objects.end(), [&](const TruthObject& object) {
            return (grown(object.box, kBoxTolerancePx) & component.box).area() > 0;
          });
    }
  }
  return components;
}

void countRegions(const cv::Mat1b& detected, const ObjectTruth& truth, ObjectCounts& counts) {
  std::map<int, std::pair<int64_t, int64_t>> pixels;  // visible, detected
  for (int y = 0; y < truth.ids.rows; ++y) {
    for (int x = 0; x < truth.ids.cols; ++x) {
      const int id = truth.ids(y, x);
      if (id == 0) continue;
      ++pixels[id].first;
      if (detected(y, x) != 0) ++pixels[id].second;
    }
  }
  for (const TruthObject& object : truth.objects) {
    const auto [visible, covered] = pixels[object.id];
    if (!object.counts || visible < kLeastVisiblePixels) continue;
    ++counts.present;
    if (static_cast<double>(covered) >= kFoundFraction * static_cast<double>(visible)) ++counts.found;
  }
}

void countBoxes(const std::vector<Component>& components, const ObjectTruth& truth, ObjectCounts& counts) {
  for (const TruthObject& object : truth.objects) {
    if (!object.counts) continue;
    ++counts.present;
    const bool found = std::any_of(components.begin(), components.end(), [&](const Component& component) {
      return intersectionOverUnion(grown(object.box, kBoxTolerancePx),
                                   grown(component.box, kBoxTolerancePx)) >= kFoundOverlap;
    });
    if (found) ++counts.found;
  }
}

}  // namespace

ObjectTruth objectsOfMask(const cv::Mat1b& mask) {
  ObjectTruth truth;
  const int count = cv::connectedComponents(mask == kTruthMoving, truth.ids, 8, CV_32S);
  for (int id = 1; id < count; ++id) truth.objects.push_back({id, {}, true});
  truth.ignored = (mask != kTruthMoving) & (mask != kTruthStatic);
  truth.has_identities = false;
  return truth;
}

ObjectCounts countObjects(const cv::Mat1b& detected, const ObjectTruth& truth) {
  check(detected, truth);
  const std::vector<Component> components = componentsOf(detected, truth);
  ObjectCounts counts;
  if (truth.ids.empty()) {
    countBoxes(components, truth, counts);
  } else {
    countRegions(detected, truth, counts);
  }
  for (const Component& component : components) {
    if (component.touches_object || 2 * component.ignored > component.area) continue;
    ++counts.false_alarms;
    counts.false_area += component.area - component.ignored;
  }
  return counts;
}

ObjectCounts ObjectMeasures::add(const cv::Mat1b& detected, const ObjectTruth& truth) {
  const ObjectCounts frame = countObjects(detected, truth);
  counts_.present += frame.present;
  counts_.found += frame.found;
  counts_.false_alarms += frame.false_alarms;
  counts_.false_area += frame.false_area;
  area_fraction_sum_ += static_cast<double>(frame.false_area) / static_cast<double>(detected.total());
  ++frames_;
  return frame;
}

double ObjectMeasures::recall() const {
  return counts_.present > 0 ? static_cast<double>(counts_.found) / static_cast<double>(counts_.present) : 0;
}

double ObjectMeasures::falseAlarmsPerFrame() const {
  return frames_ > 0 ? static_cast<double>(counts_.false_alarms) / static_cast<double>(frames_) : 0;
}

double ObjectMeasures::falseAreaFraction() const {
  return frames_ > 0 ? area_fraction_sum_ / static_cast<double>(frames_) : 0;
}

}  // namespace redbee
