// Consistency check: calibrations of the two halves of a recording must agree.
#pragma once

#include <vector>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/flight_solution.hpp"

namespace redbee::calibration {

/// Both halves start from the solution of the whole recording. Empty if a half is too short or cannot be
/// solved.
std::vector<SplitHalfEntry> splitHalf(const Recording& recording, const CalibrationInput& input,
                                      const FlightSolution& whole);

/// Ratio of the halves' differences to their standard deviations, at least 1: correlated errors (parallax,
/// tracking bias) that residuals do not show.
double disagreement(const std::vector<SplitHalfEntry>& entries);

}  // namespace redbee::calibration
