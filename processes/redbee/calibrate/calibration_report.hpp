// report.html of `redbee calibrate`: verdicts and images on one page that stands alone.
#pragma once

#include <string>

#include "processes/redbee/calibrate/calibration_files.hpp"
#include "redbee/calibration/calibration.hpp"

namespace redbee {

std::string calibrationReport(const calibration::CalibrationInput& input,
                              const calibration::CalibrationResult& result,
                              const CalibrationSubject& subject);

}  // namespace redbee
