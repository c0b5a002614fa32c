// Solution of the joint problem for a recording or half of it: from initial values to covariances.
#pragma once

#include "redbee/calibration/initial_trajectory.hpp"
#include "redbee/calibration/joint_problem.hpp"
#include "redbee/calibration/recording.hpp"

namespace redbee::calibration {

struct FlightSolution {
  JointInput input;  ///< with the selected homographies and the variance scales
  JointState state;
  JointAnalysis analysis;
  bool usable = false;
};

/// Starts from `mounting`; `priors` are those of the joint problem, except their height, which is estimated
/// unless `start_height` is given.
FlightSolution solveFlight(const Recording& recording, const CalibrationInput& input,
                           const Mounting& mounting, const JointPriors& priors,
                           const std::optional<MeasuredHeight>& start_height);

}  // namespace redbee::calibration
