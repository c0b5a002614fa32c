#include "calibration/flight_solution.hpp"

#include <algorithm>

namespace redbee::calibration {
namespace {

/// Homographies found again near what the solution predicts: the ground, where another plane had more points.
std::vector<GroundHomography> foundAgain(const FlightSolution& solution, const Recording& recording,
                                         const CalibrationInput& input) {
  std::vector<GroundHomography> ground;
  for (const IndexedMatch& match : recording.matches) {
    const Eigen::Matrix3d prediction = predictedHomography(solution.state, solution.input, match.a, match.b);
    if (!prediction.allFinite()) continue;
    auto found = groundHomography(match, input.camera, input.ransac, prediction);
    if (found) ground.push_back(*found);
  }
  return ground;
}

bool solveOnce(FlightSolution& solution) {
  JointProblem problem(solution.input, solution.state);
  if (!problem.solve()) return false;
  absorbTimeshiftStep(solution.state, solution.input);
  return true;
}

/// Variance components (Helmert 1907): each group's scale is what makes its residuals as large as the degrees of freedom that the fit
/// left to it. Vision's is taken from the median, which homographies of other planes do not move. The IMU is never believed to be
/// better than its densities say.
void rescale(JointInput& input, const JointAnalysis& analysis) {
  const auto freedomShare = [](const GroupFit& group) {
    return std::max(group.redundancy / std::max(group.measurements, 1), 0.05);
  };
  const double vision = analysis.vision.median_ratio / freedomShare(analysis.vision);
  const double imu = analysis.imu.chi2 / std::max(analysis.imu.redundancy, 1.0);
  input.vision_variance_scale = std::clamp(input.vision_variance_scale * vision, 0.01, 1e4);
  input.imu_variance_scale = std::clamp(input.imu_variance_scale * imu, 1.0, 1e6);
}

JointInput jointInput(const Recording& recording, const CalibrationInput& input, const JointPriors& priors) {
  JointInput joint;
  joint.imu = recording.imu.get();
  joint.camera = recording.camera.get();
  joint.noise = input.noise;
  joint.gravity = input.gravity;
  joint.ground = recording.ground;
  joint.target = recording.target;
  joint.heights = recording.heights;
  joint.priors = priors;
  return joint;
}

}  // namespace

FlightSolution solveFlight(const Recording& recording, const CalibrationInput& input, const Mounting& mounting,
                           const JointPriors& priors, const std::optional<MeasuredHeight>& start_height) {
  FlightSolution solution;
  solution.input = jointInput(recording, input, priors);
  solution.state = emptyState(recording.t_cam_s, mounting);
  if (recording.hasTarget()) {
    initialiseBeforeTarget(solution.state, solution.input);
  } else {
    initialiseOverGround(solution.state, solution.input);
    JointPriors& own = solution.input.priors;
    own.height_m = start_height ? start_height->height_m : cameraHeight(solution.state, 0);
    own.height_sigma_m = start_height ? start_height->sigma_m : own.height_m;
  }
  if (!solveOnce(solution)) return solution;

  constexpr int kScaleRounds = 2;
  for (int round = 0; round <= kScaleRounds; ++round) {
    if (round == 0 && !recording.hasTarget()) {
      auto ground = foundAgain(solution, recording, input);
      // A solution so wrong that it finds no ground must not lose what there was.
      if (2 * ground.size() > solution.input.ground.size()) solution.input.ground = std::move(ground);
    }
    if (!solveOnce(solution)) return solution;
    JointProblem problem(solution.input, solution.state);
    solution.analysis = problem.analyse();
    if (!solution.analysis.valid) return solution;
    if (round < kScaleRounds) rescale(solution.input, solution.analysis);
  }
  solution.usable = true;
  return solution;
}

}  // namespace redbee::calibration
