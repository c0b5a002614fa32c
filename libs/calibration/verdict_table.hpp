// The table of parameters: estimates, deviations, limits, verdicts.
#pragma once

#include <vector>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/gyro_shape.hpp"
#include "redbee/calibration/joint_problem.hpp"
#include "redbee/calibration/line_delay.hpp"

namespace redbee::calibration {

/// All parameters in the order of the report, with their verdicts.
std::vector<ParameterReport> parameterReports(const CalibrationResult& result,
                                              const JointCovariance& covariance,
                                              const CalibrationInput& input);
/// With the scales of the result's deviations: of the line delay and of the gyro's axes, which are estimated
/// on their own; after the others.
void addSensorReports(LineDelay delay, GyroShape gyro, const CalibrationInput& input,
                      CalibrationResult& result);

/// Fills result.values.kept according to the verdicts.
void keepOrRefuse(CalibrationResult& result);

}  // namespace redbee::calibration
