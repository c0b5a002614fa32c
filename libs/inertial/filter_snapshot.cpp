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
/// Sigmas that a sensor's error may be from the configured one: a configured sigma is seldom more than a
/// guess. Where it is small, the drift possible in a flight.
constexpr double kMaxSigmas = 10;
constexpr double kGyroDrift = 0.02;       // rad/s
constexpr double kAccelDrift = 0.3;       // m/s^2
constexpr double kMountingDrift = 0.035;  // rad
constexpr double kMaxTilt = 3.2;          // rad, of its sigma
constexpr double kUnitTolerance = 1e-6;
constexpr double kDoubt = 2;

double ageAt(const FilterSnapshot& known, CameraTime time) { return seconds(time - known.time); }

/// False for what is not a number.
bool isSigma(const Eigen::Vector3d& sigma, double limit) {
  return (sigma.array() >= 0).all() && (sigma.array() <= limit).all();
}

bool isSensorError(const Eigen::Vector3d& error, const Eigen::Vector3d& sigma, double limit) {
  return error.norm() <= limit && isSigma(sigma, limit);
}

bool isHeight(const FilterSnapshot& known) {
  return known.height_m >= kMinCameraHeight && known.height_m <= kMaxHeight && known.height_sigma_m > 0 &&
         known.height_sigma_m <= known.height_m;
}

bool couldBeLearned(const FilterSnapshot& known, const InertialParameters& parameters) {
  const Eigen::Matrix3d turned = known.R_CI * parameters.extrinsics.R_CI.transpose();
  return isHeight(known) && std::abs(known.up.norm() - 1) < kUnitTolerance &&
         isSigma(known.up_sigma, kMaxTilt) && known.velocity.norm() <= kMaxVelocity &&
         isSigma(known.velocity_sigma, kMaxVelocity) &&
         isSensorError(known.gyro_bias - parameters.gyro_bias, known.gyro_bias_sigma,
                       std::max(kGyroDrift, kMaxSigmas * parameters.gyro_bias_sigma)) &&
         isSensorError(known.accel_bias - parameters.accel_bias, known.accel_bias_sigma,
                       std::max(kAccelDrift, kMaxSigmas * parameters.accel_bias_sigma)) &&
         known.R_CI.allFinite() && isRotation(known.R_CI) &&
         isSensorError(logSO3(turned), known.R_CI_sigma,
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

bool isRecent(const FilterSnapshot& known, CameraTime time) {
  const double age = ageAt(known, time);
  return age >= 0 && age <= kMaxAge;
}

SnapshotCheck validate(const FilterSnapshot& known, CameraTime time, const InertialParameters& parameters) {
  if (!isPlausibleTime(known.time) || !couldBeLearned(known, parameters)) {
    return SnapshotCheck::kImplausible;
  }
  if (ageAt(known, time) < 0) return SnapshotCheck::kFuture;
  return isRecent(known, time) ? SnapshotCheck::kAccepted : SnapshotCheck::kStale;
}

FilterSnapshot aged(FilterSnapshot known, CameraTime time) {
  const double age = ageAt(known, time);
  for (Eigen::Vector3d* sigma : {&known.up_sigma, &known.velocity_sigma, &known.gyro_bias_sigma,
                                 &known.accel_bias_sigma, &known.R_CI_sigma}) {
    *sigma *= kDoubt;
  }
  known.height_m = std::max(kMinCameraHeight, known.height_m + age * known.velocity.z());
  known.height_sigma_m = std::hypot(kDoubt * known.height_sigma_m, age * known.velocity_sigma.z(),
                                    0.5 * age * age * kUnknownAcceleration);
  for (double& sigma : known.up_sigma) sigma = std::hypot(sigma, age * kUnknownRate);
  const double turned = age * kUnknownRate * known.velocity.head<2>().norm();
  for (const int axis : {0, 1, 2}) {
    double& sigma = known.velocity_sigma(axis);
    sigma = std::hypot(sigma, age * kUnknownAcceleration, axis < 2 ? turned : 0.0);
  }
  known.time = time;
  return known;
}

}  // namespace redbee
