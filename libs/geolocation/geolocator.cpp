#include "redbee/geolocation/geolocator.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/chi_square.hpp"

namespace redbee {
namespace {

constexpr double kStartVelocity_m_s = 5;  // one standard deviation, before it was measured
constexpr double kFootCorrelation_s = 1;  // a gait's step, a turn of the object
constexpr double kUnseenDecay_s = 0.5;  // what is no longer found has probably stopped; as the boxes' tracker
constexpr double kCoasting_s = 2;       // after which who is slow has stopped
constexpr double kStoppedSpeed_m_s = 0.3;  // slower than a walk
constexpr double kStoppedSigma_m_s = 0.1;  // of who has stopped
constexpr double kGateProbability = 0.9999;
constexpr size_t kMostTargets = 1024;  // what one message of them may list
constexpr int kMostGated = 5;          // then the target is where it is measured
constexpr double kSamePlaceProbability = 0.99;
constexpr double kLongestGap_s = 10;  // after which nothing is known of who moved

}  // namespace

Geolocator::Geolocator(const CameraIntrinsics& camera, const GeolocationParameters& parameters)
    : configured_(camera), intrinsics_(camera), camera_(makeCameraModel(camera)), parameters_(parameters) {}

void Geolocator::restart() {
  targets_.clear();
  last_.reset();
}

void Geolocator::predict(double seconds) {
  for (auto& [id, tracked] : targets_) {
    const bool seen = tracked.unseen_s == 0;
    tracked.filter.predict({seconds, tracked.has_stopped ? 0 : parameters_.acceleration_sigma,
                            seen ? 0 : kUnseenDecay_s, parameters_.error_correlation_s, kFootCorrelation_s});
    tracked.unseen_s += seconds;
  }
}

void Geolocator::begin(int id, const Placed& placed) {
  targets_.insert_or_assign(id, Tracked{TargetFilter(placed.measurement, kStartVelocity_m_s), placed.size,
                                        placed.range_m, placed.measurement.z});
}

/// The tracker gives who stopped and starts again a new identity: its old one goes.
void Geolocator::giveWay(const Placed& newcomer) {
  static const double gate = chiSquareQuantile(kSamePlaceProbability, 2);
  for (auto it = targets_.begin(); it != targets_.end();) {
    const bool is_same = it->second.has_stopped && !it->second.is_reported &&
                         it->second.filter.distance(newcomer.measurement) < gate;
    it = is_same ? targets_.erase(it) : std::next(it);
  }
}

void Geolocator::observe(int id, const Placed& placed) {
  const auto found = targets_.find(id);
  if (found == targets_.end()) {
    giveWay(placed);
    return begin(id, placed);
  }
  static const double gate = chiSquareQuantile(kGateProbability, 2);
  Tracked& tracked = found->second;
  if (tracked.filter.distance(placed.measurement) > gate) {
    if (++tracked.gated >= kMostGated) begin(id, placed);
    return;
  }
  tracked.gated = 0;
  tracked.filter.update(placed.measurement);
  tracked.size += 0.1 * (placed.size - tracked.size);
  tracked.range_m = placed.range_m;
  tracked.last_seen = tracked.filter.position();
  tracked.unseen_s = 0;
  tracked.has_stopped = false;
}

TargetState Geolocator::stateOf(const Tracked& tracked) {
  if (tracked.has_stopped) return TargetState::kStopped;
  if (tracked.unseen_s > 0) return TargetState::kCoasting;
  const double speed_sigma = std::sqrt(tracked.filter.covariance().bottomRightCorner<2, 2>().trace() / 2);
  const bool is_slow =
      tracked.filter.velocity().norm() < kStoppedSpeed_m_s && speed_sigma < kStoppedSpeed_m_s;
  return is_slow ? TargetState::kStopped : TargetState::kMoving;
}

bool Geolocator::isInView(const Eigen::Vector2d& position, const GroundView& view) const {
  const auto pixel = project(position, view);
  return pixel && !isCutOff(*pixel);
}

void Geolocator::noteVisibility(const std::optional<GroundView>& view,
                                const std::vector<ObservedBox>& boxes) {
  for (auto& [id, tracked] : targets_) {
    tracked.is_reported = tracked.is_seen = false;
    if (view) tracked.is_in_view = isInView(tracked.filter.position(), *view);
  }
  for (const ObservedBox& each : boxes) {
    const auto known = targets_.find(each.id);
    if (known == targets_.end()) continue;
    known->second.is_reported = true;
    known->second.is_seen = each.seen;
  }
}

/// Who is in view and no longer seen to move has stopped; of who has left the view, nothing is known soon.
void Geolocator::stopUnseen(const std::optional<GroundView>& view) {
  const auto is_forgotten = [&](const Tracked& tracked) {
    if (tracked.has_stopped) return tracked.unseen_s > parameters_.keep_stopped_s;
    const bool is_explained = tracked.is_seen || !view;
    return tracked.unseen_s > (is_explained ? kLongestGap_s : kCoasting_s);
  };
  for (auto it = targets_.begin(); it != targets_.end();) {
    Tracked& tracked = it->second;
    if (tracked.unseen_s > kCoasting_s && view && tracked.is_in_view && !tracked.is_seen &&
        !tracked.has_stopped) {
      tracked.has_stopped = true;
      tracked.filter.stop(tracked.last_seen, kStoppedSigma_m_s);
    }
    it = is_forgotten(tracked) ? targets_.erase(it) : std::next(it);
  }
}

/// Those go first that were not seen for the longest time.
void Geolocator::limitTargets() {
  while (targets_.size() > kMostTargets) {
    targets_.erase(std::max_element(targets_.begin(), targets_.end(), [](const auto& a, const auto& b) {
      return a.second.unseen_s < b.second.unseen_s;
    }));
  }
}

std::vector<StoppedTarget> Geolocator::stopped() const {
  std::vector<StoppedTarget> stopped;
  for (const auto& [id, tracked] : targets_) {
    if (!tracked.has_stopped) continue;
    stopped.push_back({id, tracked.filter.position(), tracked.filter.covariance().topLeftCorner<2, 2>(),
                       tracked.size, tracked.range_m, tracked.unseen_s});
  }
  return stopped;
}

void Geolocator::restore(const StoppedTarget& target) {
  if (targets_.count(target.id) > 0 || target.unseen_s > parameters_.keep_stopped_s) return;
  GroundMeasurement place{target.position, Eigen::Matrix<double, 2, kLastingErrors>::Zero(),
                          target.covariance};
  begin(target.id, {place, target.size, target.range_m});
  Tracked& tracked = targets_.at(target.id);
  tracked.unseen_s = target.unseen_s;
  tracked.is_reported = tracked.is_seen = false;
  tracked.has_stopped = true;
  tracked.filter.stop(target.position, kStoppedSigma_m_s);
}

std::vector<Target> Geolocator::step(CameraTime time, const std::optional<GroundView>& view,
                                     const std::vector<ObservedBox>& boxes) {
  const double elapsed = last_ ? seconds(time - *last_) : 0;
  if (elapsed < 0 || elapsed > kLongestGap_s) restart();
  last_ = time;
  refused_ = {};
  predict(std::max(0.0, elapsed));
  noteVisibility(view, boxes);
  for (const ObservedBox& each : boxes) {
    if (!each.seen || !view) continue;
    const auto known = targets_.find(each.id);
    const auto predicted =
        known != targets_.end() ? std::optional(known->second.filter.position()) : std::nullopt;
    if (const auto placed = place(each.box, *view, predicted)) observe(each.id, *placed);
  }
  stopUnseen(view);
  limitTargets();
  std::vector<Target> targets;
  targets.reserve(targets_.size());
  for (const auto& [id, tracked] : targets_) {
    const Eigen::Matrix4d& P = tracked.filter.covariance();
    targets.push_back({id, stateOf(tracked), tracked.filter.position(), tracked.filter.velocity(),
                       P.topLeftCorner<2, 2>(), P.bottomRightCorner<2, 2>(), tracked.size, tracked.range_m,
                       tracked.unseen_s});
  }
  return targets;
}

}  // namespace redbee
