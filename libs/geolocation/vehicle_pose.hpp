// What is known of the vehicle at a time, as messages say it. Body axes: forward, left, up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "redbee/geometry/time.hpp"

namespace redbee {

struct Geodetic {
  double latitude_deg = 0;  ///< WGS-84
  double longitude_deg = 0;
};

struct VehiclePose {
  ImuTime time;
  Eigen::Quaterniond R_EB;                                        ///< body to east, north, up
  Eigen::Matrix3d attitude_covariance = Eigen::Matrix3d::Zero();  ///< rad^2, rotation vector in E
  std::optional<Eigen::Vector3d> velocity;                        ///< m/s, east, north, up
  std::optional<Geodetic> global;
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Zero();  ///< m^2, of `global`, east and north
  double altitude_m = 0;                                          ///< above mean sea level, with `global`
  std::optional<double> home_altitude_m;                          ///< above the place of take-off
  std::optional<Eigen::Vector3d> local;                           ///< m, from the estimator's origin
};

struct MountAttitude {
  ImuTime time;
  std::optional<Eigen::Quaterniond> R_BM;  ///< mount to body
  std::optional<Eigen::Quaterniond> R_EM;  ///< mount to east, north, up
};

struct HeightAboveGround {
  ImuTime time;
  double height_m = 0;
  double sigma_m = 0;
};

}  // namespace redbee
