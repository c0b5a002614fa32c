#include "redbee/calibration/flight_solution.hpp"

#include <algorithm>
#include <set>

#include "redbee/calibration/ground_fit.hpp"

namespace redbee::calibration {
namespace {

/// The ground is assumed to be level while points on other surfaces are removed.
constexpr double kLevelSigma_rad = 0.001;
constexpr int kSelectionRounds = 3;
constexpr int kScaleRounds = 2;

/// A homography over several frames has the same noise and bias as one between neighbours, but measures the
/// whole motion. Those between neighbours that lie inside one are left out.
std::vector<GroundHomography> withoutCovered(const std::vector<GroundHomography>& all) {
  std::set<size_t> covered;
  for (const GroundHomography& ground : all) {
    for (size_t k = ground.a; ground.b > ground.a + 1 && k < ground.b; ++k) covered.insert(k);
  }
  std::vector<GroundHomography> kept;
  for (const GroundHomography& ground : all) {
    if (ground.b > ground.a + 1 || covered.count(ground.a) == 0) kept.push_back(ground);
  }
  return kept;
}

size_t framesSpanned(const std::vector<GroundHomography>& all) {
  size_t frames = 0;
  for (const GroundHomography& ground : all) frames += ground.b - ground.a;
  return frames;
}

/// Homographies of the ground among the points, near the solution's prediction.
std::vector<GroundHomography> groundNear(const FlightSolution& solution, const Recording& recording) {
  std::vector<GroundHomography> ground;
  for (const IndexedMatch& match : recording.matches) {
    GroundPrediction prediction;
    prediction.motion = predictedMotion(solution.state, match.a, match.b);
    prediction.translation_sigma *= static_cast<double>(match.b - match.a);
    auto found = fitGround(*match.points, recording.camera->ideal(), prediction);
    if (!found) continue;
    found->a = match.a;
    found->b = match.b;
    ground.push_back(*found);
  }
  return withoutCovered(ground);
}

bool solveOnce(FlightSolution& solution) {
  JointProblem problem(solution.input, solution.state);
  if (!problem.solve()) return false;
  absorbTimeshiftStep(solution.state, solution.input);
  return true;
}

/// Variance components (Helmert 1907): each group's scale makes its residuals consistent with its remaining
/// degrees of freedom. Vision's is taken from the median, which homographies of other planes do not affect.
/// The IMU's noise is never below its configured densities.
void rescale(JointInput& input, const JointAnalysis& analysis) {
  const auto freedomFraction = [](const GroupFit& group) {
    return std::max(group.redundancy / std::max(group.measurements, 1), 0.05);
  };
  const double vision = analysis.vision.median_ratio / freedomFraction(analysis.vision);
  const double imu = analysis.imu.chi2 / std::max(analysis.imu.redundancy, 1.0);
  input.vision_variance_scale = std::clamp(input.vision_variance_scale * vision, 0.01, 1e4);
  input.imu_variance_scale = std::clamp(input.imu_variance_scale * imu, 1.0, 1e6);
}

/// Alternates between solving over level ground and selecting the points near that solution.
bool selectGround(FlightSolution& solution, const Recording& recording, const Mounting& mounting) {
  const JointPriors wide = solution.input.priors;
  // A facade taken for ground must not rotate the camera or the vertical.
  solution.input.priors.tilt_sigma_rad = kLevelSigma_rad;
  solution.input.priors.rotation_sigma_rad = mounting.rotation_sigma_rad;
  for (int round = 0; round < kSelectionRounds; ++round) {
    if (!solveOnce(solution)) return false;
    auto ground = groundNear(solution, recording);
    // If the solution is so wrong that no ground is found, the homographies are kept.
    if (3 * framesSpanned(ground) > recording.t_cam_s.size()) solution.input.ground = std::move(ground);
  }
  solution.input.priors = wide;
  return true;
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

FlightSolution solveFlight(const Recording& recording, const CalibrationInput& input,
                           const Mounting& mounting, const JointPriors& priors,
                           const std::optional<MeasuredHeight>& start_height) {
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
  if (!recording.matches.empty() && !selectGround(solution, recording, mounting)) return solution;
  if (!solveOnce(solution)) return solution;

  for (int round = 0; round <= kScaleRounds; ++round) {
    JointProblem problem(solution.input, solution.state);
    if (!problem.solve()) return solution;
    absorbTimeshiftStep(solution.state, solution.input);
    solution.analysis = problem.analyse();
    if (!solution.analysis.valid) return solution;
    if (round < kScaleRounds) rescale(solution.input, solution.analysis);
  }
  solution.usable = true;
  return solution;
}

}  // namespace redbee::calibration
