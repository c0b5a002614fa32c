#include "redbee/geolocation/view_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kKept_s = 3;           // longer than any frame is on its way
constexpr double kHeightAge_s = 0.5;    // of an altimeter's reading, carried on by the climb rate
constexpr double kLevelHeight_m = 0.1;  // lower, the vehicle stands

/// Keeps `entries` in order of time, and those of the last seconds only.
template <typename Entry>
void insert(std::deque<Entry>& entries, const Entry& entry) {
  if (!entries.empty() && seconds(entries.back().time - entry.time) > kKept_s) entries.clear();
  const auto later = std::upper_bound(entries.begin(), entries.end(), entry.time,
                                      [](ImuTime time, const Entry& each) { return time < each.time; });
  entries.insert(later, entry);
  while (seconds(entries.back().time - entries.front().time) > kKept_s) entries.pop_front();
}

/// The two entries between which `time` lies, or the last two or the only one before it; the same twice where
/// there is one. Precondition: not empty.
template <typename Entry>
std::pair<const Entry*, const Entry*> around(const std::deque<Entry>& entries, ImuTime time) {
  const auto later = std::lower_bound(entries.begin(), entries.end(), time,
                                      [](const Entry& each, ImuTime t) { return each.time < t; });
  if (later == entries.begin()) return {&entries.front(), &entries.front()};
  if (later != entries.end()) return {&*std::prev(later), &*later};
  return {entries.size() > 1 ? &*std::prev(later, 2) : &entries.back(), &entries.back()};
}

/// Of the entry nearest to `time`.
template <typename Entry>
double ageOf(const std::pair<const Entry*, const Entry*>& pair, ImuTime time) {
  return std::min(std::abs(seconds(time - pair.first->time)), std::abs(seconds(time - pair.second->time)));
}

/// 0 at the first entry, 1 at the second, more after it; 0 where they are one, or too far apart to go on.
template <typename Entry>
double fractionOf(const std::pair<const Entry*, const Entry*>& pair, ImuTime time, double longest_s) {
  const double apart_s = seconds(pair.second->time - pair.first->time);
  if (!(apart_s > 0)) return 0;
  const double fraction = seconds(time - pair.first->time) / apart_s;
  return apart_s > 2 * longest_s && fraction > 1 ? 1 : fraction;
}

Eigen::Quaterniond turned(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double fraction) {
  const Eigen::AngleAxisd between(a.conjugate() * b);
  return (a * Eigen::Quaterniond(Eigen::AngleAxisd(fraction * between.angle(), between.axis()))).normalized();
}

template <typename Value>
std::optional<Value> between(const std::optional<Value>& a, const std::optional<Value>& b, double fraction) {
  if (!a || !b) return b ? b : a;
  return Value(*a + fraction * (*b - *a));
}

std::optional<Geodetic> between(const std::optional<Geodetic>& a, const std::optional<Geodetic>& b,
                                double fraction) {
  if (!a || !b) return b ? b : a;
  const double longitude = std::remainder(b->longitude_deg - a->longitude_deg, 360.0);
  return Geodetic{a->latitude_deg + fraction * (b->latitude_deg - a->latitude_deg),
                  a->longitude_deg + fraction * longitude};
}

std::optional<Eigen::Quaterniond> between(const std::optional<Eigen::Quaterniond>& a,
                                          const std::optional<Eigen::Quaterniond>& b, double fraction) {
  if (!a || !b) return b ? b : a;
  return turned(*a, *b, fraction);
}

}  // namespace

ViewEstimator::ViewEstimator(const GeolocationParameters& parameters, const Eigen::Matrix3d& R_CI,
                             const Eigen::Vector3d& p_IC)
    : parameters_(parameters), R_CI_(R_CI), p_IC_(p_IC), has_gimbal_(parameters.mount == "gimbal") {}

void ViewEstimator::note(const VehiclePose& pose) { insert(poses_, pose); }
void ViewEstimator::note(const MountAttitude& mount) { insert(mounts_, mount); }
void ViewEstimator::note(const HeightAboveGround& height) { insert(heights_, height); }

std::optional<VehiclePose> ViewEstimator::poseAt(ImuTime time, double& age_s) const {
  const auto pair = around(poses_, time);
  age_s = ageOf(pair, time);
  if (age_s > parameters_.max_pose_age_s) return std::nullopt;
  const double fraction = fractionOf(pair, time, parameters_.max_pose_age_s);
  const auto& [a, b] = pair;
  VehiclePose pose = fraction > 0.5 ? *b : *a;
  pose.time = time;
  pose.R_EB = turned(a->R_EB, b->R_EB, fraction);
  pose.velocity = between(a->velocity, b->velocity, fraction);
  pose.global = between(a->global, b->global, fraction);
  pose.altitude_m = a->global && b->global ? a->altitude_m + fraction * (b->altitude_m - a->altitude_m)
                                           : (b->global ? b : a)->altitude_m;
  pose.home_altitude_m = between(a->home_altitude_m, b->home_altitude_m, fraction);
  pose.local = between(a->local, b->local, fraction);
  return pose;
}

std::optional<Eigen::Quaterniond> ViewEstimator::mountAt(ImuTime time, const Eigen::Quaterniond& R_EB,
                                                         double& age_s) const {
  if (mounts_.empty()) return std::nullopt;
  const auto pair = around(mounts_, time);
  age_s = ageOf(pair, time);
  if (age_s > parameters_.max_pose_age_s) return std::nullopt;
  const double fraction = fractionOf(pair, time, parameters_.max_pose_age_s);
  // Of the two the earth's: the gimbal's own sensors hold it, the body only carries it.
  if (auto earth = between(pair.first->R_EM, pair.second->R_EM, fraction)) return earth;
  const auto body = between(pair.first->R_BM, pair.second->R_BM, fraction);
  return body ? std::optional(R_EB * *body) : std::nullopt;
}

bool ViewEstimator::addHeight(ImuTime time, const VehiclePose& pose, GroundView& view) const {
  if (!heights_.empty()) {
    const auto pair = around(heights_, time);
    const HeightAboveGround& nearest =
        std::abs(seconds(time - pair.first->time)) < std::abs(seconds(time - pair.second->time))
            ? *pair.first
            : *pair.second;
    const double since_s = seconds(time - nearest.time);
    if (std::abs(since_s) <= kHeightAge_s) {
      view.height_m = nearest.height_m + (pose.velocity ? pose.velocity->z() * since_s : 0);
      view.height_sigma_m = nearest.sigma_m;
      return view.height_m > kLevelHeight_m;
    }
  }
  if (!pose.home_altitude_m && !pose.local) return false;
  view.height_m = pose.home_altitude_m ? *pose.home_altitude_m : pose.local->z();
  view.height_sigma_m = parameters_.home_height_sigma_m;
  return view.height_m > kLevelHeight_m;
}

ViewEstimate ViewEstimator::at(ImuTime time) {
  ViewEstimate estimate;
  const auto failed = [&](ViewFault fault) {
    estimate.fault = fault;
    return estimate;
  };
  if (poses_.empty()) return failed(ViewFault::kNoPose);
  const auto pose = poseAt(time, estimate.age_s);
  if (!pose) return failed(ViewFault::kStalePose);
  const auto place = frame_.placeOf(*pose);
  if (!place) return failed(ViewFault::kNoPosition);
  GroundView view;
  Eigen::Matrix3d R_EC = pose->R_EB.toRotationMatrix() * R_CI_.transpose();
  view.position = place->position;
  if (has_gimbal_) {
    const auto R_EM = mountAt(time, pose->R_EB, estimate.age_s);
    if (!R_EM) return failed(ViewFault::kNoMount);
    R_EC = R_EM->toRotationMatrix() * R_CI_.transpose();
  } else {
    view.position += (pose->R_EB * p_IC_).head<2>();
  }
  view.R_EC = Eigen::AngleAxisd(place->convergence, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R_EC;
  view.attitude_covariance = pose->attitude_covariance;
  view.position_covariance = place->covariance;
  if (!addHeight(time, *pose, view)) return failed(ViewFault::kNoHeight);
  estimate.has_ground_altitude = pose->global.has_value();
  estimate.ground_altitude_m = pose->altitude_m - view.height_m;
  estimate.view = view;
  return estimate;
}

}  // namespace redbee
