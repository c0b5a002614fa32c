// report.html of `redbee calibrate`: verdicts and plots on one page.
#pragma once

#include <string>

#include "processes/redbee/calibrate/calibration_files.hpp"
#include "redbee/calibration/calibration.hpp"

namespace redbee {

std::string calibrationReport(const calibration::CalibrationInput& input,
                              const calibration::CalibrationResult& result,
                              const CalibrationSubject& subject);

}  // namespace redbee
