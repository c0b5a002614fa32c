#include "redbee/inertial/filter_snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {
namespace {

constexpr double kMaxAge = 2.0;       // s: the unknown acceleration alone is 4 m by then
constexpr double kMaxHeight = 1e4;    // m
constexpr double kMaxVelocity = 200;  // m/s
/// Largest deviation of a sensor's error from the configured one, in configured sigmas, which are seldom
/// accurate; if they are small, the drift possible in a flight.
constexpr double kMaxSigmas = 10;
constexpr double kGyroDrift = 0.02;       // rad/s
constexpr double kAccelDrift = 0.3;       // m/s^2
constexpr double kMountingDrift = 0.035;  // rad
constexpr double kMaxTilt = 3.2;          // rad, of its sigma
constexpr double kUnitTolerance = 1e-6;
constexpr double kDoubt = 2;

double ageAt(const FilterSnapshot& snapshot, CameraTime time) { return seconds(time - snapshot.time); }

/// False for what is not a number.
bool isSigma(const Eigen::Vector3d& sigma, double limit) {
  return (sigma.array() >= 0).all() && (sigma.array() <= limit).all();
}

bool isSensorError(const Eigen::Vector3d& error, const Eigen::Vector3d& sigma, double limit) {
  return error.norm() <= limit && isSigma(sigma, limit);
}

bool isHeight(const FilterSnapshot& snapshot) {
  return snapshot.height_m >= kMinCameraHeight && snapshot.height_m <= kMaxHeight &&
         snapshot.height_sigma_m > 0 && snapshot.height_sigma_m <= snapshot.height_m;
}

bool couldBeLearned(const FilterSnapshot& snapshot, const InertialParameters& parameters) {
  const Eigen::Matrix3d turned = snapshot.R_CI * parameters.extrinsics.R_CI.transpose();
  return isHeight(snapshot) && std::abs(snapshot.up.norm() - 1) < kUnitTolerance &&
         isSigma(snapshot.up_sigma, kMaxTilt) && snapshot.velocity.norm() <= kMaxVelocity &&
         isSigma(snapshot.velocity_sigma, kMaxVelocity) &&
         isSensorError(snapshot.gyro_bias - parameters.gyro_bias, snapshot.gyro_bias_sigma,
                       std::max(kGyroDrift, kMaxSigmas * parameters.gyro_bias_sigma)) &&
         isSensorError(snapshot.accel_bias - parameters.accel_bias, snapshot.accel_bias_sigma,
                       std::max(kAccelDrift, kMaxSigmas * parameters.accel_bias_sigma)) &&
         snapshot.R_CI.allFinite() && isRotation(snapshot.R_CI) &&
         isSensorError(logSO3(turned), snapshot.R_CI_sigma,
                       std::max(kMountingDrift, kMaxSigmas * parameters.extrinsicRotationSigma()));
}

}  // namespace

const char* toString(SnapshotCheck check) {
  switch (check) {
    case SnapshotCheck::kAccepted:
      return "accepted";
    case SnapshotCheck::kNotWanted:
      return "not wanted";
    case SnapshotCheck::kImplausible:
      return "implausible";
    case SnapshotCheck::kFuture:
      return "from the future";
    case SnapshotCheck::kStale:
      return "too old";
  }
  return "unknown";
}

bool isRecent(const FilterSnapshot& snapshot, CameraTime time) {
  const double age = ageAt(snapshot, time);
  return age >= 0 && age <= kMaxAge;
}

SnapshotCheck validate(const FilterSnapshot& snapshot, CameraTime time,
                       const InertialParameters& parameters) {
  if (!isPlausibleTime(snapshot.time) || !couldBeLearned(snapshot, parameters)) {
    return SnapshotCheck::kImplausible;
  }
  if (ageAt(snapshot, time) < 0) return SnapshotCheck::kFuture;
  return isRecent(snapshot, time) ? SnapshotCheck::kAccepted : SnapshotCheck::kStale;
}

FilterSnapshot aged(FilterSnapshot snapshot, CameraTime time) {
  const double age = ageAt(snapshot, time);
  for (Eigen::Vector3d* sigma : {&snapshot.up_sigma, &snapshot.velocity_sigma, &snapshot.gyro_bias_sigma,
                                 &snapshot.accel_bias_sigma, &snapshot.R_CI_sigma}) {
    *sigma *= kDoubt;
  }
  snapshot.height_m = std::max(kMinCameraHeight, snapshot.height_m + age * snapshot.velocity.z());
  snapshot.height_sigma_m = std::hypot(kDoubt * snapshot.height_sigma_m, age * snapshot.velocity_sigma.z(),
                                       0.5 * age * age * kUnknownAcceleration);
  for (double& sigma : snapshot.up_sigma) sigma = std::hypot(sigma, age * kUnknownRate);
  const double turned = age * kUnknownRate * snapshot.velocity.head<2>().norm();
  for (const int axis : {0, 1, 2}) {
    double& sigma = snapshot.velocity_sigma(axis);
    sigma = std::hypot(sigma, age * kUnknownAcceleration, axis < 2 ? turned : 0.0);
  }
  snapshot.time = time;
  return snapshot;
}

}  // namespace redbee
