#include "redbee/inertial/mount_track.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace redbee {
namespace {

constexpr std::size_t kMaxMountSamples = 20000;  // at 200 Hz 100 s, which no frame waits for
constexpr double kSetBack_s = 2;         // a sample that is older than the newest by this is of another clock
constexpr double kNormTolerance = 1e-3;  // of a quaternion's norm

}  // namespace

bool MountTrack::add(const MountSample& sample) {
  const bool is_rotation =
      sample.q_IM.coeffs().allFinite() && std::abs(sample.q_IM.norm() - 1) < kNormTolerance;
  if (!isPlausibleTime(sample.time) || !is_rotation) return false;
  const MountSample kept{sample.time + fromSeconds(parameters_.timeshift_s), sample.q_IM.normalized()};
  if (!samples_.empty() && seconds(samples_.back().time - kept.time) > kSetBack_s) samples_.clear();
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), kept.time,
                                      [](const MountSample& each, ImuTime time) { return each.time < time; });
  if (place != samples_.end() && place->time == kept.time) {
    *place = kept;
    return true;
  }
  samples_.insert(place, kept);
  if (samples_.size() > kMaxMountSamples) samples_.pop_front();
  return true;
}

bool MountTrack::reaches(ImuTime time) const { return !samples_.empty() && samples_.back().time >= time; }

MountRotation MountTrack::at(ImuTime time) const {
  MountRotation mount;
  mount.variance = parameters_.angleVariance();
  mount.is_known = false;
  const auto later = std::lower_bound(samples_.begin(), samples_.end(), time,
                                      [](const MountSample& each, ImuTime t) { return each.time < t; });
  if (later == samples_.end()) return mount;
  if (later->time != time && later == samples_.begin()) return mount;
  // At a sample's own time the step before it, or after it where it is the first, gives the rate.
  const auto second = later == samples_.begin() ? std::next(later) : later;
  if (second == samples_.end()) {
    mount.R_MI = later->q_IM.conjugate().toRotationMatrix();
    mount.is_known = true;
    return mount;
  }
  const auto first = std::prev(second);
  const double apart_s = seconds(second->time - first->time);
  const bool is_gap = apart_s > parameters_.max_gap_s;
  if (is_gap && later->time != time) return mount;
  const double fraction = seconds(time - first->time) / apart_s;
  mount.R_MI = first->q_IM.slerp(fraction, second->q_IM).conjugate().toRotationMatrix();
  mount.is_known = true;
  if (is_gap) return mount;
  const Eigen::AngleAxisd turn(first->q_IM.conjugate() * second->q_IM);
  mount.rate_M = turn.angle() / apart_s * turn.axis();
  return mount;
}

void MountTrack::eraseBefore(ImuTime time) {
  // The last one before it is still one end of an interpolation.
  while (samples_.size() > 1 && samples_[1].time <= time) samples_.pop_front();
}

}  // namespace redbee
