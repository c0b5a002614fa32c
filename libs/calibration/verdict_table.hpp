// The table of parameters: estimates, deviations, limits, verdicts.
#pragma once

#include <vector>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/joint_problem.hpp"

namespace redbee::calibration {

/// All parameters in the order of the report, with their verdicts.
std::vector<ParameterReport> parameterReports(const CalibrationResult& result,
                                              const JointCovariance& covariance,
                                              const CalibrationInput& input);

/// Fills result.values.kept according to the verdicts.
void keepOrRefuse(CalibrationResult& result);

}  // namespace redbee::calibration
