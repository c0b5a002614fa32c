#include "redbee/inertial/mount_track.hpp"

#include <cmath>
#include <iterator>

#include "redbee/inertial/sample_track.hpp"

namespace redbee {
namespace {

constexpr double kNormTolerance = 1e-3;  // of a quaternion's norm

}  // namespace

bool MountTrack::add(const MountSample& sample) {
  const bool is_rotation =
      sample.q_IM.coeffs().allFinite() && std::abs(sample.q_IM.norm() - 1) < kNormTolerance;
  if (!isPlausibleTime(sample.time) || !is_rotation) return false;
  const Duration shift = fromSeconds(parameters_.timeshift_s);
  insertInOrder(samples_, MountSample{sample.time + shift, sample.q_IM.normalized()});
  return true;
}

bool MountTrack::reaches(ImuTime time) const { return !samples_.empty() && samples_.back().time >= time; }

MountRotation MountTrack::at(ImuTime time) const {
  MountRotation mount;
  mount.variance = parameters_.angleVariance();
  mount.is_known = false;
  const auto later = firstFrom(samples_, time);
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

void MountTrack::eraseBefore(ImuTime time) { eraseUpTo(samples_, time); }

}  // namespace redbee
