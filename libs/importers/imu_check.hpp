// What is implausible about the IMU of a recording.
#pragma once

#include <string>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/importers/imu_units.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// One line each, with the fix.
struct ImuFindings {
  std::vector<std::string> faults;    ///< every result would be wrong: units, gravity, the clock
  std::vector<std::string> warnings;  ///< results may suffer: rate, holes, constant values, coverage
};

/// `read_as`: the units in which the table was read, for the advice.
ImuFindings checkImu(const std::vector<ImuSample>& imu, CameraTime first_frame, CameraTime last_frame,
                     const ImuUnits& read_as = {});

}  // namespace redbee
