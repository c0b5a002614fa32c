// Units of IMU tables, by the names that people give them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace redbee {

struct ImuUnits {
  std::string gyro = "rad/s";
  std::string accel = "m/s2";
  std::string time = "s";
};

/// Name and factor to rad/s, m/s^2 or s.
using UnitTable = std::vector<std::pair<std::string, double>>;
const UnitTable& gyroUnits();
const UnitTable& accelUnits();
const UnitTable& timeUnits();

std::vector<std::string> namesOf(const UnitTable& table);
/// Throws InputError, with `option`, for a name that is not in the table.
double factorOf(const UnitTable& table, const std::string& name, const std::string& option);

}  // namespace redbee
