#include "processes/serve/flight_map.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace redbee {
namespace {

constexpr size_t kSnapshotPoses = 1000;

template <typename Message>
void sortByTime(std::vector<Message>& messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.utime < b.utime; });
}

/// The number of messages that are not later than a time.
template <typename Message>
size_t countUntil(const std::vector<Message>& messages, int64_t utime) {
  const auto later = std::upper_bound(messages.begin(), messages.end(), utime,
                                      [](int64_t time, const Message& m) { return time < m.utime; });
  return static_cast<size_t>(later - messages.begin());
}

}  // namespace

FlightMap::FlightMap(const Configuration& configuration)
    : channel_(configuration.channels.pose),
      timeshift_us_(fromSeconds(configuration.inertial.extrinsics.timeshift_s).count()),
      snapshots_{MapBuilder(configuration)} {}

void FlightMap::finish() {
  sortByTime(poses_);
  sortByTime(targets_);
  sortByTime(motions_);
  MapBuilder map = snapshots_.front();
  for (size_t i = 0; i < poses_.size(); ++i) {
    if (i > 0 && i % kSnapshotPoses == 0) snapshots_.push_back(map);
    map.onPose(poses_[i]);
  }
}

MapView FlightMap::at(int64_t utime) const {
  const size_t poses = countUntil(poses_, utime + timeshift_us_);
  const size_t snapshot = std::min(poses / kSnapshotPoses, snapshots_.size() - 1);
  MapBuilder map = snapshots_[snapshot];
  for (size_t i = snapshot * kSnapshotPoses; i < poses; ++i) map.onPose(poses_[i]);
  const size_t motions = countUntil(motions_, utime);
  if (motions > 0 && motions_[motions - 1].utime == utime) map.onFused(motions_[motions - 1]);
  if (const size_t targets = countUntil(targets_, utime); targets > 0) map.onTargets(targets_[targets - 1]);
  MapView view = map.view(utime);
  if (poses_.empty()) view.note = "the flight has no " + channel_ + ": it was recorded without an autopilot";
  return view;
}

}  // namespace redbee
