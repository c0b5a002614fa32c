// What the autopilot measures and estimates, in SI units and our axes (axes.hpp), on our clock.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <variant>

#include "redbee/geometry/time.hpp"
#include "redbee/mavlink/clock_estimator.hpp"

namespace redbee::mavlink {

struct ImuReading {
  ImuTime time;
  int64_t device_us = 0;  ///< us, as the autopilot counts
  Eigen::Vector3d gyro;   ///< rad/s, FLU
  Eigen::Vector3d accel;  ///< m/s^2, specific force, FLU
  Eigen::Vector3d mag;    ///< gauss, FLU; zero where it is not known
  double pressure_hpa = 0;
  double pressure_altitude_m = 0;
};

struct HeightReading {
  ImuTime time;
  double height_m = 0;  ///< of the camera above the ground, along the vertical
  double sigma_m = 0;
};

struct GlobalPosition {
  double latitude_deg = 0;  ///< WGS-84
  double longitude_deg = 0;
  double altitude_m = 0;                       ///< above mean sea level
  std::optional<double> ellipsoid_altitude_m;  ///< above WGS-84's ellipsoid
  double home_altitude_m = 0;                  ///< above home
  Eigen::Matrix3d covariance;                  ///< m^2, ENU
};

struct Pose {
  ImuTime time;
  Eigen::Quaterniond enu_from_flu;
  Eigen::Matrix3d attitude_covariance;      ///< rad^2, rotation vector in ENU, left perturbation
  std::optional<Eigen::Vector3d> velocity;  ///< m/s, ENU
  Eigen::Matrix3d velocity_covariance = Eigen::Matrix3d::Zero();
  std::optional<GlobalPosition> global;
  std::optional<Eigen::Vector3d> local;  ///< m, ENU, from the origin of the autopilot's estimator
};

struct GimbalAttitude {
  ImuTime time;
  std::optional<Eigen::Quaterniond> body_from_gimbal;  ///< both FLU
  std::optional<Eigen::Quaterniond> enu_from_gimbal;   ///< FLU to ENU
};

struct Lens {
  ImuTime time;
  std::optional<double> zoom;      ///< 0..1 of its range
  std::optional<double> focal_px;  ///< of an image `width_px` wide
  int width_px = 0;
};

using Measurement = std::variant<ImuReading, HeightReading, Pose, GimbalAttitude, Lens, ClockState>;

}  // namespace redbee::mavlink
