// An IMU that swings under gravity, as the tests of importers need it.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "redbee/inertial/imu.hpp"

namespace redbee::test {

/// Swings by half a radian at 0.5 Hz about two axes, vibrates a little; in rad/s and m/s^2.
inline std::vector<ImuSample> swingingImu(double rate_hz, double seconds, double start_s = 0) {
  std::vector<ImuSample> samples;
  Eigen::Quaterniond R_WI = Eigen::Quaterniond::Identity();
  const double period = 1 / rate_hz;
  for (int k = 0; k < static_cast<int>(rate_hz * seconds); ++k) {
    const double t = k * period;
    ImuSample sample;
    sample.time = ImuTime(fromSeconds(start_s + t));
    sample.gyro = {1.5 * std::cos(M_PI * t), 0.4 * std::sin(M_PI * t), 0.3 + 1e-3 * std::sin(90 * t)};
    sample.accel = R_WI.conjugate() * Eigen::Vector3d(0.1 * std::sin(70 * t), 0.1 * std::cos(80 * t), 9.81);
    samples.push_back(sample);
    const Eigen::Vector3d angle = period * sample.gyro;
    R_WI = R_WI * Eigen::Quaterniond(Eigen::AngleAxisd(angle.norm(), angle.normalized()));
  }
  return samples;
}

}  // namespace redbee::test
