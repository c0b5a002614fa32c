// The noise of an IMU at rest.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Of the sensors at rest, all in Kalibr's units.
struct RestNoise {
  double gyro_density;   ///< rad/s/sqrt(Hz), of the noisiest axis
  double accel_density;  ///< m/s^2/sqrt(Hz)
  double seconds;        ///< of rest that this is of
};

/// Why nothing is known of the noise.
enum class RestStatus { kAtRest, kMoves, kTooShort };

struct RestReport {
  RestStatus status = RestStatus::kTooShort;
  double turning = 0;  ///< rad/s, standard deviation of the mean rates of half seconds
  std::optional<RestNoise> noise;
};

/// Noise densities from the two-sample (Allan) variance over a tenth of a second, which neither a bias nor
/// the filter of the sensor touches: N = sigma(tau) sqrt(tau). Rest is judged by means over half a second,
/// where white noise of ten times the `expected` density is less than what counts as motion.
RestReport restNoise(const std::vector<ImuSample>& samples, const ImuNoise& expected);

}  // namespace redbee
