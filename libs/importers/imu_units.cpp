#include "redbee/importers/imu_units.hpp"

#include <cmath>

#include "redbee/files/input_error.hpp"

namespace redbee {

const UnitTable& gyroUnits() {
  static const UnitTable table{{"rad/s", 1}, {"deg/s", M_PI / 180}, {"mrad/s", 1e-3}};
  return table;
}

const UnitTable& accelUnits() {
  constexpr double kStandardGravity = 9.80665;  // m/s^2
  static const UnitTable table{{"m/s2", 1}, {"g", kStandardGravity}, {"mg", 1e-3 * kStandardGravity}};
  return table;
}

const UnitTable& timeUnits() {
  static const UnitTable table{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  return table;
}

std::vector<std::string> namesOf(const UnitTable& table) {
  std::vector<std::string> names;
  for (const auto& [name, factor] : table) names.push_back(name);
  return names;
}

double factorOf(const UnitTable& table, const std::string& name, const std::string& option) {
  std::string known;
  for (const auto& [unit, factor] : table) {
    if (unit == name) return factor;
    known += (known.empty() ? "" : ", ") + unit;
  }
  throw InputError(option + " " + name + ": no such unit; known are " + known);
}

}  // namespace redbee
