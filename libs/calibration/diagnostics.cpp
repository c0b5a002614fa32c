#include "redbee/calibration/diagnostics.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace redbee::calibration {
namespace {

constexpr size_t kScatterPoints = 2500;

/// The solution's path under the nominal extrinsics.
JointState underNominal(const FlightSolution& solution, const InertialExtrinsics& nominal) {
  JointState state = solution.state;
  state.timeshift_step_s = nominal.timeshift_s - state.timeshift_s;
  absorbTimeshiftStep(state, solution.input);
  state.q_CI = Eigen::Quaterniond(nominal.R_CI);
  state.p_IC = nominal.p_IC;
  return state;
}

void addHomographyErrors(Diagnostics& diagnostics, const FlightSolution& solution, const JointState& nominal,
                         const Recording& recording) {
  const CameraIntrinsics& size = recording.camera->ideal();
  for (const GroundHomography& ground : solution.input.ground) {
    const Eigen::Matrix3d before = predictedHomography(nominal, solution.input, ground.a, ground.b);
    const Eigen::Matrix3d after = predictedHomography(solution.state, solution.input, ground.a, ground.b);
    diagnostics.pair_t_s.push_back(recording.t_cam_s[ground.b]);
    diagnostics.pair_error_before_px.push_back(meanTransferError(before, ground.H, size.width, size.height));
    diagnostics.pair_error_after_px.push_back(meanTransferError(after, ground.H, size.width, size.height));
  }
}

void addScatter(Diagnostics& diagnostics, const FlightSolution& solution, const JointState& nominal,
                const Recording& recording, double inlier_px) {
  std::map<std::pair<size_t, size_t>, const GroundHomography*> measured;
  size_t points = 0;
  for (const GroundHomography& ground : solution.input.ground) {
    measured[{ground.a, ground.b}] = &ground;
    points += static_cast<size_t>(ground.points);
  }
  const size_t stride = std::max<size_t>(1, points / kScatterPoints);
  size_t seen = 0;
  for (const IndexedMatch& match : recording.matches) {
    const auto ground = measured.find({match.a, match.b});
    if (ground == measured.end()) continue;
    const Eigen::Matrix3d before = predictedHomography(nominal, solution.input, match.a, match.b);
    const Eigen::Matrix3d after = predictedHomography(solution.state, solution.input, match.a, match.b);
    for (size_t i = 0; i < match.points->previous.size(); ++i) {
      const Eigen::Vector2d x_a(match.points->previous[i].x, match.points->previous[i].y);
      const Eigen::Vector2d x_b(match.points->current[i].x, match.points->current[i].y);
      if ((x_b - transfer(ground->second->H, x_a)).norm() > inlier_px || seen++ % stride != 0) continue;
      diagnostics.scatter_before_px.push_back(x_b - transfer(before, x_a));
      diagnostics.scatter_after_px.push_back(x_b - transfer(after, x_a));
    }
  }
}

/// Difference [px] of two poses at the target's origin: rotation and translation error at its distance.
double targetError(const JointState& state, const TargetPose& pose, double focal_px) {
  const FrameState& frame = state.frames[pose.frame];
  const Eigen::Quaterniond q_CG = state.q_CI * frame.q_GI.conjugate();
  const Eigen::Vector3d p_CT = -(q_CG * (frame.p_GI + frame.q_GI * state.p_IC));
  const double turn = (q_CG * state.q_GT).angularDistance(pose.q_CT);
  return focal_px * std::hypot(turn, (p_CT - pose.p_CT).norm() / pose.p_CT.norm());
}

void addTargetErrors(Diagnostics& diagnostics, const FlightSolution& solution, const JointState& nominal,
                     const Recording& recording) {
  for (const TargetPose& pose : solution.input.target) {
    const double focal = recording.camera->ideal().fx;
    diagnostics.pair_t_s.push_back(recording.t_cam_s[pose.frame]);
    diagnostics.pair_error_before_px.push_back(targetError(nominal, pose, focal));
    diagnostics.pair_error_after_px.push_back(targetError(solution.state, pose, focal));
  }
}

}  // namespace

double accelerationExcitation(const JointState& state) {
  double squares = 0;
  size_t count = 0;
  for (size_t k = 0; k + 1 < state.frames.size(); ++k) {
    const double dt = state.frames[k + 1].t_cam_s - state.frames[k].t_cam_s;
    squares += ((state.frames[k + 1].v_GI - state.frames[k].v_GI) / dt).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
}

Diagnostics diagnose(const FlightSolution& solution, const Recording& recording,
                     const CalibrationInput& input, const RotationAlignment& alignment) {
  Diagnostics diagnostics;
  diagnostics.alignment = alignment;
  const JointState nominal = underNominal(solution, input.nominal);
  if (recording.hasTarget()) {
    addTargetErrors(diagnostics, solution, nominal, recording);
  } else {
    addHomographyErrors(diagnostics, solution, nominal, recording);
    addScatter(diagnostics, solution, nominal, recording, input.ransac.inlier_px);
  }
  for (size_t i = 0; i < solution.state.biases.size(); ++i) {
    diagnostics.bias_t_s.push_back(solution.state.bias_begin_s[i]);
    diagnostics.gyro_bias.push_back(solution.state.biases[i].gyro);
    diagnostics.accel_bias.push_back(solution.state.biases[i].accel);
  }
  for (size_t k = 0; k < solution.state.frames.size(); ++k) {
    diagnostics.frame_t_s.push_back(solution.state.frames[k].t_cam_s);
    diagnostics.height_m.push_back(cameraHeight(solution.state, k));
  }
  return diagnostics;
}

}  // namespace redbee::calibration
