#include "redbee/detection/objects/object_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "redbee/detection/objects/association.hpp"
#include "redbee/detection/objects/log_odds.hpp"
#include "redbee/geometry/assignment.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/imaging/box_overlap.hpp"

namespace redbee {
namespace {

constexpr double kSeenVelocityDecay_s = 5;
constexpr double kMissedVelocityDecay_s = 0.5;  // what is no longer found has probably stopped
constexpr double kUnknownMotion_px = 100;       // per root s: the camera's, without a homography

constexpr double kMissedLogOdds = -1;      // of a frame without a component
constexpr double kMostEvidence_s = 0.5;    // so that a track that has faded is soon no longer reported
constexpr double kLeastEvidence_s = -0.1;  // an unconfirmed track below this is deleted
constexpr double kUnconfirmedMissed_s = 0.1;

constexpr double kPart = 0.6;     // fraction of a component inside a track's box that makes it a part of it
constexpr double kCovered = 0.5;  // fraction of a track's box inside a component that may show it
constexpr double kOverlapping = 0.3;  // fraction of a box inside another's: one object
constexpr double kRecentlySeen_s = 1;
constexpr double kApart_s = 1;             // tracks that have been two for as long are two objects
constexpr double kDistinctVelocity = 2;    // squared Mahalanobis distance of two objects' velocities
constexpr double kTimeTolerance_s = 1e-9;  // rounding of times that were added up

cv::Rect pixelsOf(const cv::Rect2d& box) {
  const cv::Point low(cvRound(box.x), cvRound(box.y));
  return {low, cv::Point(cvRound(box.x + box.width), cvRound(box.y + box.height))};
}

bool movesApart(const BoxFilter& a, const BoxFilter& b) {
  const Eigen::Vector2d difference = a.velocity() - b.velocity();
  const Eigen::Matrix2d S = (a.covariance() + b.covariance()).bottomRightCorner<2, 2>();
  return squaredMahalanobis(difference, S) > kDistinctVelocity;
}

}  // namespace

ObjectTracker::ObjectTracker(const ObjectParameters& parameters, const ParallaxParameters& parallax)
    : parameters_(parameters),
      neutral_log_odds_(logOdds(parameters.neutral)),
      direction_error_(parallax.direction_error),
      camera_(parallax.nearest_depth_fraction) {}

void ObjectTracker::propagate(Duration elapsed, const std::optional<Eigen::Matrix3d>& ground,
                              const std::optional<CameraStep>& camera) {
  elapsed_s_ = std::max(0.0, seconds(elapsed));
  camera_.propagate(elapsed_s_, ground, camera);
  for (Track& track : tracks_) {
    const double decay_s = track.missed_s > 0 ? kMissedVelocityDecay_s : kSeenVelocityDecay_s;
    track.filter.predict(ground.value_or(Eigen::Matrix3d::Identity()), elapsed_s_, decay_s);
    if (ground) track.origin = transfer(*ground, track.origin);
    if (!ground) track.filter.loosen(kUnknownMotion_px * kUnknownMotion_px * elapsed_s_);
    track.age_s += elapsed_s_;
  }
}

/// Confirmed tracks that the box covers and that are different objects: they move differently, or have been
/// apart for long. Two parts of one object are neither.
std::vector<const ObjectTracker::Track*> ObjectTracker::coveredApart(const cv::Rect2d& box) const {
  std::vector<const Track*> covered;
  for (const Track& track : tracks_) {
    if (track.id == 0 || track.missed_s > kRecentlySeen_s) continue;
    if (coveredFraction(track.filter.box(), box) < kCovered) continue;
    const bool is_apart = std::all_of(covered.begin(), covered.end(), [&](const Track* other) {
      return coveredFraction(track.filter.box(), other->filter.box()) < kOverlapping &&
             (std::min(track.age_s, other->age_s) > kApart_s || movesApart(track.filter, other->filter));
    });
    if (is_apart) covered.push_back(&track);
  }
  return covered;
}

void ObjectTracker::splitMerged(ForegroundComponents& found) const {
  const size_t count = found.components.size();
  for (size_t c = 0; c < count; ++c) {
    const std::vector<const Track*> covered = coveredApart(found.components[c].box);
    if (covered.size() < 2) continue;
    std::vector<cv::Rect2d> boxes(covered.size());
    for (size_t i = 0; i < boxes.size(); ++i) boxes[i] = covered[i]->filter.box();
    splitComponent(found, c, boxes);
  }
}

std::vector<size_t> ObjectTracker::unassigned(Strength strength,
                                              const std::vector<Component>& components) const {
  std::vector<bool> is_taken(components.size(), false);
  for (const Track& track : tracks_) {
    for (const size_t c : track.components) is_taken[c] = true;
  }
  std::vector<size_t> free;
  for (size_t c = 0; c < components.size(); ++c) {
    if (is_taken[c] || components[c].area_px < parameters_.min_area_px) continue;
    const bool is_strong = components[c].peak > parameters_.threshold;
    if (strength == Strength::kAny || is_strong == (strength == Strength::kStrong)) free.push_back(c);
  }
  return free;
}

void ObjectTracker::assignTo(bool confirmed, Strength strength, const ForegroundComponents& found) {
  std::vector<Track*> tracks;
  std::vector<const BoxFilter*> filters;
  for (Track& track : tracks_) {
    if (!track.components.empty() || (track.id > 0) != confirmed) continue;
    tracks.push_back(&track);
    filters.push_back(&track.filter);
  }
  const std::vector<int> assigned =
      associate(filters, found.components, unassigned(strength, found.components), found.image);
  for (size_t t = 0; t < tracks.size(); ++t) {
    if (assigned[t] != kUnassigned) tracks[t]->components.push_back(static_cast<size_t>(assigned[t]));
  }
}

/// What is left inside a track's predicted box belongs to it: halves of a body.
void ObjectTracker::absorbParts(const std::vector<Component>& components) {
  for (const size_t c : unassigned(Strength::kAny, components)) {
    Track* whole = nullptr;
    double most = kPart;
    for (Track& track : tracks_) {
      if (track.components.empty()) continue;
      const double inside = coveredFraction(components[c].box, track.filter.box());
      if (inside <= most) continue;
      most = inside;
      whole = &track;
    }
    if (whole != nullptr) whole->components.push_back(c);
  }
}

void ObjectTracker::assignAll(const ForegroundComponents& found) {
  for (Track& track : tracks_) track.components.clear();
  assignTo(true, Strength::kStrong, found);
  assignTo(true, Strength::kWeak, found);
  absorbParts(found.components);
  assignTo(false, Strength::kAny, found);
}

void ObjectTracker::begin(size_t component, const ForegroundComponents& found) {
  const Component& first = found.components[component];
  const BoxMeasurement measured = measurementOf(first, found.image);
  Track track{BoxFilter(measured), first};
  track.origin = track.filter.centre();
  notePlace(track, measured);
  track.components.push_back(component);
  tracks_.push_back(track);
}

void ObjectTracker::notePlace(Track& track, const BoxMeasurement& measured) const {
  track.path.push_back({camera_.current(), measured.centre(), measured.centreVariance()});
  while (!camera_.remembers(track.path.front().frame)) track.path.pop_front();
}

double ObjectTracker::motionLogOdds(const Track& track) const {
  const auto likelihood = movingLogLikelihood(track.path, camera_, direction_error_);
  if (!likelihood) return stayedLogOdds(track.age_s, track.farthest);
  return movingLogOdds(track.age_s, *likelihood / std::max(1.0, track.last.residual_around));
}

void ObjectTracker::observe(Track& track, const ForegroundComponents& found) const {
  track.last = joined(found.components, track.components);
  const BoxMeasurement measured = measurementOf(track.last, found.image);
  track.filter.update(measured);
  notePlace(track, measured);
  const double moved_px = (track.filter.centre() - track.origin).norm();
  track.farthest = std::max(track.farthest, moved_px / track.filter.size());
  track.evidence_s +=
      elapsed_s_ * (logOdds(track.last.peak) - neutral_log_odds_ + gainLogOdds(track.last.gain) +
                    restlessLogOdds(track.last.residual_around) + motionLogOdds(track));
  track.evidence_s = std::min(track.evidence_s, std::max(kMostEvidence_s, parameters_.confirm_s));
  track.missed_s = 0;
  track.skipped_s = 0;
}

void ObjectTracker::miss(Track& track) const {
  track.missed_s += elapsed_s_;
  track.evidence_s += elapsed_s_ * kMissedLogOdds;
  // After a long time it takes as much to report it again as a new one.
  if (track.id > 0) track.evidence_s = std::max(track.evidence_s, -parameters_.confirm_s);
}

void ObjectTracker::deleteLostTracks(cv::Size image) {
  const auto lost = [&](const Track& track) {
    if (track.id == 0 && track.evidence_s < kLeastEvidence_s) return true;
    const double most_s = track.id > 0 ? parameters_.max_missed_s : kUnconfirmedMissed_s;
    const bool is_missed = track.missed_s - track.skipped_s > most_s + kTimeTolerance_s;
    const Eigen::Vector2d at = track.filter.centre();
    const bool is_inside = cv::Rect2d(cv::Point2d(), image).contains({at.x(), at.y()});
    return is_missed || (track.missed_s > 0 && !is_inside);
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), lost), tracks_.end());
}

TrackedObjects ObjectTracker::report(cv::Size image) {
  TrackedObjects objects;
  for (Track& track : tracks_) {
    const bool is_found = !track.components.empty();
    if (track.id == 0 && is_found && track.evidence_s >= parameters_.confirm_s - kTimeTolerance_s)
      track.id = next_id_++;
    if (track.id == 0) continue;
    Detection detection;
    detection.id = track.id;
    detection.area_px = track.last.area_px;
    detection.score = track.last.score;
    detection.seen = is_found && track.evidence_s >= -kTimeTolerance_s;
    detection.box = (detection.seen ? track.last.box : pixelsOf(track.filter.box())) & cv::Rect({}, image);
    if (detection.box.empty()) continue;
    objects.detections.push_back(detection);
    if (!detection.seen) continue;
    objects.components.insert(objects.components.end(), track.components.begin(), track.components.end());
  }
  return objects;
}

std::vector<Detection> ObjectTracker::skip(cv::Size image) {
  for (Track& track : tracks_) {
    track.components.clear();
    track.missed_s += elapsed_s_;
    if (track.id > 0) track.skipped_s = std::min(track.skipped_s + elapsed_s_, parameters_.max_missed_s);
  }
  elapsed_s_ = 0;
  deleteLostTracks(image);
  return report(image).detections;
}

TrackedObjects ObjectTracker::update(ForegroundComponents& found) {
  splitMerged(found);
  assignAll(found);
  for (Track& track : tracks_) {
    if (track.components.empty()) {
      miss(track);
    } else {
      observe(track, found);
    }
  }
  elapsed_s_ = 0;
  const std::vector<size_t> fresh = unassigned(Strength::kAny, found.components);
  deleteLostTracks(found.image);
  for (const size_t c : fresh) begin(c, found);
  return report(found.image);
}

}  // namespace redbee
