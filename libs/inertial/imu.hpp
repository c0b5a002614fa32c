// Measurements, noise and extrinsics of IMU and altimeter.
#pragma once

#include <Eigen/Core>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// One IMU measurement, in the IMU frame I, on the IMU's clock.
struct ImuSample {
  ImuTime time{};
  Eigen::Vector3d gyro;   ///< rad/s, angular rate of I relative to the ground, in I
  Eigen::Vector3d accel;  ///< m/s^2, specific force in I (+9.81 upwards at rest)
};

/// Height of the camera above the ground plane, on the IMU's clock.
struct AltitudeSample {
  ImuTime time{};
  double height_m = 0;  ///< m
  double sigma_m = 0;   ///< m, one standard deviation; > 0
};

/// Kalibr's continuous-time noise model.
struct ImuNoise {
  double gyro_noise_density = 1.7e-4;   ///< rad/s/sqrt(Hz)
  double accel_noise_density = 2.0e-3;  ///< m/s^2/sqrt(Hz)
  double gyro_random_walk = 2.0e-5;     ///< rad/s^2/sqrt(Hz)
  double accel_random_walk = 4.0e-4;    ///< m/s^3/sqrt(Hz)
};

/// Pose of the camera on the IMU, time shift, and start height; the offline calibration estimates these.
struct InertialExtrinsics {
  Eigen::Matrix3d R_CI = Eigen::Matrix3d::Identity();  ///< turns IMU coordinates into camera coordinates
  Eigen::Vector3d p_IC = Eigen::Vector3d::Zero();      ///< camera centre in the IMU frame [m]
  double timeshift_s = 0;                              ///< t_imu = t_cam + timeshift (Kalibr's sign)
  double start_height_m = 2.0;        ///< camera above the ground plane at the first frame [m]
  double start_height_sigma_m = 1.0;  ///< its standard deviation [m]
};

}  // namespace redbee
