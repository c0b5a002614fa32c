// The IMU of all simulated flights.
#pragma once

#include <cmath>

#include "redbee/simulation/imu_simulator.hpp"

namespace redbee::test {

/// Consumer grade: 0.005 deg/s/sqrt(Hz), 200 ug/sqrt(Hz).
inline ImuNoise consumerNoise() { return {8.7e-5, 1.96e-3, 2e-5, 4e-4}; }

/// With biases of 0.4 deg/s and 0.1 m/s^2.
struct ConsumerImu : simulation::ImuSimulatorParameters {
  explicit ConsumerImu(unsigned seed_of_noise) {
    noise = consumerNoise();
    gyro_bias = Eigen::Vector3d(0.5, -0.7, 0.5).normalized() * 0.4 * M_PI / 180;
    accel_bias = Eigen::Vector3d(0.6, 0.5, -0.6).normalized() * 0.1;
    seed = seed_of_noise;
  }
};

struct PerfectImu : simulation::ImuSimulatorParameters {
  PerfectImu() { noise = {0, 0, 0, 0}; }
};

}  // namespace redbee::test
