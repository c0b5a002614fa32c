// Simulated measurements of an imperfect IMU and altimeter on a trajectory.
#pragma once

#include <random>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::simulation {

struct ImuSimulatorParameters {
  double rate_hz = 400;
  ImuNoise noise;                                        ///< set every density to zero for a perfect IMU
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   ///< rad/s at the start
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< m/s^2 at the start
  double gravity = 9.81;
  unsigned seed = 1;
};

/// Samples on [begin_s, end_s] of the trajectory's time. time = start + t.
std::vector<ImuSample> simulateImu(const Trajectory& trajectory, double begin_s, double end_s, ImuTime start,
                                   const ImuSimulatorParameters& parameters);

/// Height of the camera above z = 0 with white noise.
std::vector<AltitudeSample> simulateAltimeter(const Trajectory& trajectory,
                                              const InertialExtrinsics& extrinsics, double begin_s,
                                              double end_s, ImuTime start, double rate_hz, double sigma_m,
                                              unsigned seed);

/// Exact motion of the camera between two trajectory times (IMU clock) over the plane z = 0.
PlaneMotion exactMotion(const Trajectory& trajectory, const InertialExtrinsics& extrinsics, double t_a,
                        double t_b);

}  // namespace redbee::simulation
