#include "redbee/calibration/initial_trajectory.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

/// Preintegrations between consecutive frames, without accelerometer bias.
std::vector<Preintegration> stepsBetweenFrames(const JointState& state, const JointInput& input) {
  std::vector<Preintegration> steps;
  for (size_t k = 0; k + 1 < state.frames.size(); ++k) {
    const double from = state.frames[k].t_cam_s + state.timeshift_s;
    const double to = state.frames[k + 1].t_cam_s + state.timeshift_s;
    steps.push_back(preintegrate(*input.imu, from, to, state.biases.front(), input.noise));
  }
  return steps;
}

/// Attitudes from the gyro; upright by the sum of all velocity changes, in which gravity dominates every
/// manoeuvre.
void initialiseAttitudes(JointState& state, const std::vector<Preintegration>& steps) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d upwards = Eigen::Vector3d::Zero();
  for (size_t k = 0; k < steps.size(); ++k) {
    state.frames[k].q_GI = Eigen::Quaterniond(R);
    upwards += R * steps[k].v;
    R = nearestRotation(R * steps[k].R);
  }
  state.frames.back().q_GI = Eigen::Quaterniond(R);
  const Eigen::Quaterniond upright = rotationBetween(upwards, Eigen::Vector3d::UnitZ());
  for (FrameState& frame : state.frames) frame.q_GI = (upright * frame.q_GI).normalized();
}

void velocitiesFromPositions(JointState& state) {
  const size_t n = state.frames.size();
  for (size_t k = 0; k < n; ++k) {
    const FrameState& before = state.frames[k > 0 ? k - 1 : 0];
    const FrameState& after = state.frames[std::min(k + 1, n - 1)];
    state.frames[k].v_GI = (after.p_GI - before.p_GI) / (after.t_cam_s - before.t_cam_s);
  }
}

/// Steps of the camera from each frame to the next in units of the height at the former, in G; frames without
/// a homography continue at the same velocity.
std::vector<Eigen::Vector3d> relativeSteps(const JointState& state, const JointInput& input) {
  const size_t n = state.frames.size();
  std::vector<Eigen::Vector3d> steps(n > 0 ? n - 1 : 0, Eigen::Vector3d::Zero());
  std::vector<bool> known(steps.size(), false);
  for (const GroundHomography& ground : input.ground) {
    if (ground.b != ground.a + 1) continue;
    const Eigen::Matrix3d R_CaG = (state.q_CI * state.frames[ground.a].q_GI.conjugate()).toRotationMatrix();
    const Eigen::Matrix3d R_CbG = (state.q_CI * state.frames[ground.b].q_GI.conjugate()).toRotationMatrix();
    constexpr double kUnitHeight = 1;  // the translation is then in units of the height
    const PlaneMotion motion{R_CbG * R_CaG.transpose(), Eigen::Vector3d::Zero(), -R_CaG.col(2), kUnitHeight};
    const Eigen::Vector3d t = translationFromHomography(input.camera->K(), ground.H, motion);
    constexpr double kLargestStep = 0.3;  // heights a frame: beyond it the homography is not the ground's
    if (!t.allFinite() || t.norm() > kLargestStep) continue;
    steps[ground.a] = -R_CbG.transpose() * t;
    known[ground.a] = true;
  }
  for (size_t k = 1; k < steps.size(); ++k) {
    if (!known[k]) steps[k] = steps[k - 1];
  }
  return steps;
}

/// Camera path in units of the first height; the ground is z = 0, so z starts at 1.
std::vector<Eigen::Vector3d> relativePath(const JointState& state, const JointInput& input) {
  std::vector<Eigen::Vector3d> path{Eigen::Vector3d::UnitZ()};
  for (const Eigen::Vector3d& step : relativeSteps(state, input)) {
    const double height = path.back().z();
    Eigen::Vector3d next = path.back() + height * step;
    next.z() = std::clamp(next.z(), 0.9 * height, 1.1 * height);
    path.push_back(next);
  }
  return path;
}

double heightFromAltimeter(const JointState& state, const JointInput& input,
                           const std::vector<Eigen::Vector3d>& path) {
  double measured = 0, relative = 0;
  for (const HeightObservation& height : input.heights) {
    const auto after =
        std::lower_bound(state.frames.begin(), state.frames.end(), height.t_imu_s - state.timeshift_s,
                         [](const FrameState& frame, double t) { return frame.t_cam_s < t; });
    if (after == state.frames.end()) continue;
    const double z = path[static_cast<size_t>(after - state.frames.begin())].z();
    const double weight = 1.0 / (height.sigma_m * height.sigma_m);
    measured += weight * height.height_m * z;
    relative += weight * z * z;
  }
  return relative > 0 ? measured / relative : 0.0;
}

/// A second difference of the path over `reach` frames to either side, and the accelerometer's measurement of
/// it.
struct Curvature {
  Eigen::Vector3d path;      ///< in units of the first height
  Eigen::Vector3d measured;  ///< m, gravity taken off
  Eigen::Matrix3d by_bias;   ///< of `measured`, by the accelerometer's bias [m / (m/s^2)]
  double square_s2;          ///< factor of a constant error of acceleration in G [s^2]
};

/// With dv_k the velocity change over step k: v_{k+1} - v_k = dv_k, and positions by the trapezoidal rule.
std::vector<Curvature> curvatures(const JointState& state, const JointInput& input,
                                  const std::vector<Preintegration>& steps,
                                  const std::vector<Eigen::Vector3d>& path) {
  const auto n = static_cast<int>(state.frames.size());
  const double duration = state.frames.back().t_cam_s - state.frames.front().t_cam_s;
  const int reach = std::max(2, static_cast<int>(0.4 * n / duration));
  const Eigen::Vector3d gravity(0, 0, -input.gravity);
  std::vector<Eigen::Vector3d> velocity(1, Eigen::Vector3d::Zero()), position(1, Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> velocity_by_bias(1, Eigen::Matrix3d::Zero()),
      position_by_bias(1, Eigen::Matrix3d::Zero());
  for (size_t k = 0; k < steps.size(); ++k) {
    const Eigen::Matrix3d R = state.frames[k].q_GI.toRotationMatrix();
    const double dt = steps[k].dt_s;
    position.push_back(position.back() + velocity.back() * dt + R * steps[k].p + 0.5 * dt * dt * gravity);
    velocity.push_back(velocity.back() + R * steps[k].v + dt * gravity);
    position_by_bias.push_back(position_by_bias.back() + velocity_by_bias.back() * dt +
                               R * steps[k].p_by_accel);
    velocity_by_bias.push_back(velocity_by_bias.back() + R * steps[k].v_by_accel);
  }
  std::vector<Curvature> all;
  for (int k = reach; k + reach < n; ++k) {
    const auto second = [&](const auto& x) {
      const auto here = static_cast<size_t>(k), r = static_cast<size_t>(reach);
      return (x[here + r] - 2.0 * x[here] + x[here - r]).eval();
    };
    const double span = 0.5 * (state.frames[static_cast<size_t>(k + reach)].t_cam_s -
                               state.frames[static_cast<size_t>(k - reach)].t_cam_s);
    Curvature c;
    c.path = second(path);
    c.measured = second(position);
    c.by_bias = second(position_by_bias);
    c.square_s2 = span * span;
    all.push_back(c);
  }
  return all;
}

}  // namespace

JointState emptyState(const std::vector<double>& t_cam_s, const Mounting& mounting) {
  JointState state;
  state.q_CI = Eigen::Quaterniond(mounting.R_CI);
  state.p_IC = mounting.p_IC;
  state.timeshift_s = mounting.timeshift_s;
  for (const double t : t_cam_s) {
    FrameState frame;
    frame.t_cam_s = t;
    state.frames.push_back(frame);
  }
  const double duration = t_cam_s.back() - t_cam_s.front();
  const int stretches = std::max(1, static_cast<int>(std::lround(duration / kBiasStretch_s)));
  for (int i = 0; i < stretches; ++i) {
    state.bias_begin_s.push_back(t_cam_s.front() + duration * i / stretches);
    state.biases.push_back({mounting.gyro_bias, Eigen::Vector3d::Zero()});
  }
  return state;
}

double heightFromAcceleration(const JointState& state, const JointInput& input,
                              const std::vector<Eigen::Vector3d>& path) {
  const auto all = curvatures(state, input, stepsBetweenFrames(state, input), path);
  // Unknown: height, accelerometer bias, horizontal error of gravity's direction. h path - by_bias b - e s^2
  // = measured.
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6d b = Vector6d::Zero();
  double squares = 0;
  for (const Curvature& c : all) {
    Eigen::Matrix<double, 3, 6> row;
    row << c.path, -c.by_bias, c.square_s2 * Eigen::Matrix<double, 3, 2>::Identity();
    A += row.transpose() * row;
    b += row.transpose() * c.measured;
    squares += c.measured.squaredNorm();
  }
  A.diagonal() += 1e-9 * Vector6d::Ones() * std::max(A.trace(), 1e-12);
  const Vector6d x = A.ldlt().solve(b);
  const double residual = squares - x.dot(b);
  const double freedom = std::max(3.0 * static_cast<double>(all.size()) - 6.0, 1.0);
  const double sigma = std::sqrt(std::max(residual, 0.0) / freedom * A.inverse()(0, 0));
  // Second differences overlap and are correlated: hence the strict limit.
  return x(0) > 0.1 && sigma < 0.05 * x(0) ? x(0) : 0.0;
}

void initialiseOverGround(JointState& state, const JointInput& input) {
  initialiseAttitudes(state, stepsBetweenFrames(state, input));
  const std::vector<Eigen::Vector3d> path = relativePath(state, input);
  double height = heightFromAltimeter(state, input, path);
  if (height <= 0) height = heightFromAcceleration(state, input, path);
  if (height <= 0) height = input.priors.height_m;
  for (size_t k = 0; k < path.size(); ++k) {
    state.frames[k].p_GI = height * path[k] - state.frames[k].q_GI * state.p_IC;
  }
  const Eigen::Vector3d place(state.frames.front().p_GI.x(), state.frames.front().p_GI.y(), 0);
  for (FrameState& frame : state.frames) frame.p_GI -= place;
  velocitiesFromPositions(state);
}

void initialiseBeforeTarget(JointState& state, const JointInput& input) {
  const auto steps = stepsBetweenFrames(state, input);
  Eigen::Vector3d upwards_T = Eigen::Vector3d::Zero();
  for (const TargetPose& pose : input.target) {
    FrameState& frame = state.frames[pose.frame];
    frame.q_GI = pose.q_CT.conjugate() * state.q_CI;
    frame.p_GI = -(pose.q_CT.conjugate() * pose.p_CT) - frame.q_GI * state.p_IC;
    if (pose.frame < steps.size()) upwards_T += frame.q_GI * steps[pose.frame].v;
  }
  state.q_GT = rotationBetween(upwards_T, Eigen::Vector3d::UnitZ());
  for (FrameState& frame : state.frames) {
    frame.q_GI = (state.q_GT * frame.q_GI).normalized();
    frame.p_GI = state.q_GT * frame.p_GI;
  }
  velocitiesFromPositions(state);
}

}  // namespace redbee::calibration
