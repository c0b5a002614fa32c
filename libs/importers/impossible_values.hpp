// Values that no sensor of a vehicle measures, as a damaged part of a recording holds them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Finite, and within what any IMU or altimeter measures: 200 rad/s, 2000 m/s^2, 20 km.
bool isPossible(const ImuSample& sample);
bool isPossible(const AltitudeSample& sample);
bool isPossibleTurn(const Eigen::Vector3d& gyro);
bool isPossibleForce(const Eigen::Vector3d& accel);

/// The part of a recording's values that may be impossible: more than this are not left out.
inline constexpr double kMostImpossible = 0.1;

/// Leaves out what is not possible, and says so in a line for the summary (empty: there was none). Where more
/// than a tenth of an IMU's are not, none is left out: their unit is another, or they are none of a sensor;
/// checkImu() says which.
std::string leaveOutImpossible(std::vector<ImuSample>& imu);
std::string leaveOutImpossible(std::vector<AltitudeSample>& altitudes);

}  // namespace redbee
