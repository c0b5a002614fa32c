#include "redbee/detection/objects/object_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

constexpr double kVelocityRate = 0.3;       // of the newest step in an object's velocity
constexpr double kMissedVelocity = 0.85;    // fraction of its velocity that a missed object keeps per frame
constexpr double kReachInDiagonals = 0.75;  // of the larger box: how far apart a match may be
constexpr double kReach_px = 4;             // and this much further; one more for each missed frame
constexpr int kUnmatched = -1;
constexpr double kFull = 255;  // P_FG of 1

Eigen::Vector2d centreOf(const cv::Rect& box) { return {box.x + 0.5 * box.width, box.y + 0.5 * box.height}; }

double diagonal(const cv::Rect& box) { return std::hypot(box.width, box.height); }

cv::Rect boxAt(const cv::Rect& box, const Eigen::Vector2d& centre) {
  return {static_cast<int>(std::lround(centre.x() - 0.5 * box.width)),
          static_cast<int>(std::lround(centre.y() - 0.5 * box.height)), box.width, box.height};
}

/// Gated distance of a component from an object: 0 at the same position, above 1 no match. The gate scales
/// with the larger of the two boxes and grows with the number of missed frames.
double misfit(const Eigen::Vector2d& centre, const cv::Rect& box, int missed, const Detection& component) {
  const double reach =
      kReachInDiagonals * std::max(diagonal(box), diagonal(component.box)) + kReach_px + missed;
  return (centre - centreOf(component.box)).norm() / reach;
}

cv::Mat1b disc(int diameter) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {diameter, diameter}); }

/// Pixels above the lower threshold, after opening and closing. Only the bounding box of the foreground is
/// processed; it is returned in `part`.
cv::Mat1b foregroundPart(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                         const ObjectParameters& parameters, cv::Rect& part) {
  cv::Mat1b mask = probability > kFull * std::min(parameters.extent_threshold, parameters.threshold);
  mask.setTo(0, unknown);
  const int reach = std::max(parameters.opening_px, parameters.closing_px);
  part = cv::boundingRect(mask);
  if (part.empty()) return {};
  part = cv::Rect(part.x - reach, part.y - reach, part.width + 2 * reach, part.height + 2 * reach) &
         cv::Rect({}, mask.size());
  mask = mask(part).clone();
  if (mask.empty()) return mask;
  if (parameters.opening_px > 0) cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disc(parameters.opening_px));
  if (parameters.closing_px > 0) cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disc(parameters.closing_px));
  mask.setTo(0, unknown(part));
  return mask;
}

}  // namespace

ForegroundComponents findComponents(const cv::Mat1b& probability, const cv::Mat1b& unknown,
                                    const ObjectParameters& parameters) {
  ForegroundComponents found;
  found.mask = cv::Mat1b::zeros(probability.size());
  cv::Rect part;
  const cv::Mat1b mask = foregroundPart(probability, unknown, parameters, part);
  if (mask.empty()) return found;
  cv::Mat1i labels, statistics;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
  for (int label = 1; label < count; ++label) {
    const int* row = statistics[label];
    if (row[cv::CC_STAT_AREA] < parameters.min_area_px) continue;
    Detection component;
    const cv::Rect in_part(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                           row[cv::CC_STAT_HEIGHT]);
    component.box = in_part + part.tl();
    component.area_px = row[cv::CC_STAT_AREA];
    const cv::Mat1b own = labels(in_part) == label;
    double surest = 0;
    cv::minMaxLoc(probability(component.box), nullptr, &surest, nullptr, nullptr, own);
    if (surest <= kFull * parameters.threshold) continue;
    component.score = cv::mean(probability(component.box), own)[0] / kFull;
    found.mask(component.box).setTo(255, own);
    found.components.push_back(component);
  }
  return found;
}

void ObjectTracker::propagate(const Eigen::Matrix3d& ground) {
  for (Object& object : objects_) object.centre = transfer(ground, object.centre) + object.velocity;
}

void ObjectTracker::associate(const std::vector<Detection>& components,
                              std::vector<int>& component_of_object) const {
  struct Pair {
    double misfit;
    size_t object;
    size_t component;
  };
  std::vector<Pair> pairs;
  for (size_t o = 0; o < objects_.size(); ++o) {
    for (size_t c = 0; c < components.size(); ++c) {
      const Object& object = objects_[o];
      const double value = misfit(object.centre, object.last.box, object.missed, components[c]);
      if (value < 1) pairs.push_back({value, o, c});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.misfit < b.misfit; });
  component_of_object.assign(objects_.size(), kUnmatched);
  std::vector<bool> taken(components.size(), false);
  for (const Pair& pair : pairs) {
    if (taken[pair.component] || component_of_object[pair.object] != kUnmatched) continue;
    taken[pair.component] = true;
    component_of_object[pair.object] = static_cast<int>(pair.component);
  }
}

void ObjectTracker::observe(Object& object, const Detection& component) const {
  const Eigen::Vector2d centre = centreOf(component.box);
  const Eigen::Vector2d surprise = (centre - object.centre) / (object.missed + 1);
  object.velocity += kVelocityRate * surprise;
  object.centre = centre;
  const int id = object.last.id;
  object.last = component;
  object.last.id = id;
  ++object.hits;
  object.missed = 0;
  object.skipped = 0;
}

void ObjectTracker::miss(Object& object) {
  object.velocity *= kMissedVelocity;
  ++object.missed;
}

void ObjectTracker::deleteLostTracks(const cv::Rect& view) {
  const auto lost = [&](const Object& object) {
    // An unconfirmed track is deleted at its first miss.
    const int max_missed = object.confirmed ? parameters_.max_missed_frames : 0;
    const bool in_view = (boxAt(object.last.box, object.centre) & view).area() > 0;
    return object.missed - object.skipped > max_missed || !in_view;
  };
  objects_.erase(std::remove_if(objects_.begin(), objects_.end(), lost), objects_.end());
}

std::vector<Detection> ObjectTracker::confirmedTracks(const cv::Rect& view) {
  std::vector<Detection> confirmed;
  for (Object& object : objects_) {
    if (object.hits < parameters_.confirm_frames) continue;
    if (!object.confirmed) object.last.id = next_id_++;
    object.confirmed = true;
    Detection detection = object.last;
    detection.seen = object.missed == 0;
    if (!detection.seen) detection.box = boxAt(object.last.box, object.centre) & view;
    confirmed.push_back(detection);
  }
  return confirmed;
}

std::vector<Detection> ObjectTracker::skip(cv::Size image) {
  for (Object& object : objects_) {
    miss(object);
    if (object.confirmed && object.skipped < parameters_.max_missed_frames) ++object.skipped;
  }
  deleteLostTracks({{}, image});
  return confirmedTracks({{}, image});
}

std::vector<Detection> ObjectTracker::update(const std::vector<Detection>& components, cv::Size image) {
  std::vector<int> component_of_object;
  associate(components, component_of_object);
  std::vector<bool> known(components.size(), false);
  for (size_t o = 0; o < objects_.size(); ++o) {
    Object& object = objects_[o];
    if (component_of_object[o] != kUnmatched) {
      const auto c = static_cast<size_t>(component_of_object[o]);
      known[c] = true;
      observe(object, components[c]);
    } else {
      miss(object);
    }
  }
  deleteLostTracks({{}, image});
  for (size_t c = 0; c < components.size(); ++c) {
    if (known[c]) continue;
    Object object{components[c], centreOf(components[c].box), Eigen::Vector2d::Zero()};
    object.last.id = 0;
    objects_.push_back(object);
  }
  return confirmedTracks({{}, image});
}

}  // namespace redbee
