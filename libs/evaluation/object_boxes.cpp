#include "redbee/evaluation/object_boxes.hpp"

#include <map>

#include "redbee/imaging/box_overlap.hpp"

namespace redbee {
namespace {

struct Region {
  cv::Rect box;
  int64_t pixels = 0;
};

std::map<int, Region> visibleRegions(const cv::Mat1i& ids) {
  std::map<int, Region> regions;
  for (int y = 0; y < ids.rows; ++y) {
    for (int x = 0; x < ids.cols; ++x) {
      if (ids(y, x) == 0) continue;
      Region& region = regions[ids(y, x)];
      region.box |= cv::Rect(x, y, 1, 1);
      ++region.pixels;
    }
  }
  return regions;
}

bool isIgnored(const cv::Rect2d& box, const cv::Mat1b& ignored) {
  if (ignored.empty()) return false;
  const cv::Rect inside = cv::Rect(cvRound(box.x), cvRound(box.y), cvRound(box.width), cvRound(box.height)) &
                          cv::Rect({}, ignored.size());
  return !inside.empty() && 2 * cv::countNonZero(ignored(inside)) > inside.area();
}

}  // namespace

ObjectBoxes::ObjectBoxes(const ObjectTruth& truth, int64_t least_visible) : ignored_(truth.ignored) {
  if (truth.ids.empty()) {
    for (const TruthObject& object : truth.objects)
      objects_.push_back({{object.id, object.box},
                          object.counts && object.box.area() >= static_cast<double>(least_visible)});
    return;
  }
  const std::map<int, Region> regions = visibleRegions(truth.ids);
  for (const TruthObject& object : truth.objects) {
    const auto region = regions.find(object.id);
    if (region == regions.end()) continue;
    objects_.push_back({{object.id, cv::Rect2d(region->second.box)},
                        object.counts && region->second.pixels >= least_visible});
  }
}

FrameBoxes ObjectBoxes::compared(const std::vector<TrackedBox>& detected, double min_overlap) const {
  FrameBoxes boxes;
  for (const Object& object : objects_) {
    if (object.counts) boxes.truth.push_back(object.box);
  }
  for (const TrackedBox& detection : detected) {
    double best = 0;
    bool counts = true;
    for (const Object& object : objects_) {
      const double overlap = intersectionOverUnion(detection.box, object.box.box);
      if (overlap <= best) continue;
      best = overlap;
      counts = object.counts;
    }
    const bool matches = best >= min_overlap;
    if (matches ? counts : !isIgnored(detection.box, ignored_)) boxes.detected.push_back(detection);
  }
  return boxes;
}

}  // namespace redbee
