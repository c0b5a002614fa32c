// Whether gyro and accelerometer of a recording are in the units in which they were read.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "redbee/importers/imu_check.hpp"

namespace redbee {

/// Preconditions of all that take samples: there are several, in order.
double medianPeriod_s(const std::vector<ImuSample>& imu);

/// The first unit but `read_as` that fits; empty if none does. `factor`: from the values as they were read.
std::string firstUnit(const UnitTable& table, const std::string& read_as, const std::string& option,
                      const std::function<bool(double factor)>& fits);

/// Gravity has to be in the accelerometer's values.
void checkGravity(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings);

/// The gyro has to turn gravity as the accelerometer sees it turn.
void checkTurns(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings);

}  // namespace redbee
