// Gravity in a recording's specific force, also where the sensor is shaken.
#pragma once

#include <optional>
#include <vector>

#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Whether a length [m/s^2] can be that of gravity. Another unit is off by a factor of nine at least.
bool isGravity(double length);

/// Median length of the specific force [m/s^2]. Precondition: `imu` is not empty.
double medianForce(const std::vector<ImuSample>& imu);

/// Length [m/s^2] of the mean specific force, turned into one attitude by the gyro, whose values count
/// `gyro_scale` times: the median over windows of some seconds. What shakes the sensor, be it many times as
/// strong as gravity, has little part in it, as the velocity at a window's end is much the same as at its
/// beginning. Needs both sensors in their units: a gyro that is wrong averages gravity away, too.
/// std::nullopt for less than a second without a hole.
std::optional<double> meanGravity(const std::vector<ImuSample>& imu, double gyro_scale = 1);

}  // namespace redbee
