// Series for the report: residuals of the solution, and of the nominal values.
#pragma once

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/flight_solution.hpp"

namespace redbee::calibration {

Diagnostics diagnose(const FlightSolution& solution, const Recording& recording,
                     const CalibrationInput& input, const RotationAlignment& alignment);

/// rms of the drone's own acceleration over the recording [m/s^2], from the change of the frames' velocities.
double accelerationExcitation(const JointState& state);

}  // namespace redbee::calibration
