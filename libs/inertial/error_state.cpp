#include "redbee/inertial/error_state.hpp"

#include <cmath>

#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr int kMovingSize = kCloneAttitude;  // the clone and the mounting are constant
constexpr double kMaxSpeed = 1e3;            // m/s: a faster state is divergence

using MovingMatrix = Eigen::Matrix<double, kMovingSize, kMovingSize>;

struct Step {
  double dt;
  Eigen::Vector3d rate;         // bias free, mean over the step
  Eigen::Matrix3d turn;         // orientation at the end in that at the beginning
  Eigen::Vector3d force_begin;  // bias free, in I at the beginning
  Eigen::Vector3d force_end;    // bias free, in I at the beginning
};

Step makeStep(const NavigationState& state, const ImuKnot& from, const ImuKnot& to) {
  Step step;
  step.dt = seconds(to.sample.time - from.sample.time);
  step.rate = 0.5 * (from.sample.gyro + to.sample.gyro) - state.gyro_bias;
  step.turn = expSO3(step.rate * step.dt);
  step.force_begin = from.sample.accel - state.accel_bias;
  step.force_end = step.turn * (to.sample.accel - state.accel_bias);
  return step;
}

MovingMatrix transition(const NavigationState& state, const Step& step) {
  const double dt = step.dt;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d force = 0.5 * (step.force_begin + step.force_end);
  const Eigen::Matrix3d velocity_by_attitude = -state.R_GI * skew(force) * dt;
  MovingMatrix F = MovingMatrix::Identity();
  F.block<3, 3>(kAttitude, kAttitude) = step.turn.transpose();
  F.block<3, 3>(kAttitude, kGyroBias) = -rightJacobianSO3(step.rate * dt) * dt;
  F.block<3, 3>(kVelocity, kAttitude) = velocity_by_attitude;
  F.block<3, 3>(kVelocity, kAccelBias) = -state.R_GI * dt;
  F.block<3, 3>(kPosition, kAttitude) = 0.5 * dt * velocity_by_attitude;
  F.block<3, 3>(kPosition, kAccelBias) = -0.5 * dt * dt * state.R_GI;
  F.block<3, 3>(kPosition, kVelocity) = dt * I;
  return F;
}

double square(double x) { return x * x; }

/// White noise over the step. Inside a gap the true motion is constant but unknown: the contributions of its
/// steps add up to (unknown * gap)^2.
MovingMatrix processNoise(const Step& step, double gap_s, const PropagationParameters& parameters) {
  const ImuNoise& noise = parameters.noise;
  const double hole = gap_s > parameters.max_gap_s ? gap_s : 0.0;
  const double gyro = square(noise.gyro_noise_density) + square(kUnknownRate) * hole;
  const double accel = square(noise.accel_noise_density) + square(kUnknownAcceleration) * hole;
  const double dt = step.dt;
  MovingMatrix Q = MovingMatrix::Zero();
  for (int i = 0; i < 3; ++i) {
    Q(kAttitude + i, kAttitude + i) = gyro * dt;
    Q(kVelocity + i, kVelocity + i) = accel * dt;
    Q(kPosition + i, kPosition + i) = accel * dt * dt * dt / 3;
    Q(kPosition + i, kVelocity + i) = Q(kVelocity + i, kPosition + i) = accel * dt * dt / 2;
    Q(kGyroBias + i, kGyroBias + i) = square(noise.gyro_random_walk) * dt;
    Q(kAccelBias + i, kAccelBias + i) = square(noise.accel_random_walk) * dt;
  }
  return Q;
}

void moveCovariance(ErrorCovariance& P, const MovingMatrix& F, const MovingMatrix& Q) {
  constexpr int kRest = kErrorSize - kMovingSize;
  using Cross = Eigen::Matrix<double, kMovingSize, kRest>;
  const MovingMatrix moved =
      mappedCovariancePlus(F, MovingMatrix(P.topLeftCorner<kMovingSize, kMovingSize>()), Q);
  const Cross cross = product(F, Cross(P.topRightCorner<kMovingSize, kRest>()));
  P.topLeftCorner<kMovingSize, kMovingSize>() = 0.5 * (moved + moved.transpose());
  P.topRightCorner<kMovingSize, kRest>() = cross;
  P.bottomLeftCorner<kRest, kMovingSize>() = cross.transpose();
}

}  // namespace

void propagate(NavigationState& state, const ImuKnot& from, const ImuKnot& to,
               const PropagationParameters& parameters) {
  const Step step = makeStep(state, from, to);
  if (step.dt <= 0) return;
  moveCovariance(state.P, transition(state, step), processNoise(step, to.gap_s, parameters));

  // Specific force runs linearly from one knot to the other in G; its integrals are then exact.
  const Eigen::Vector3d gravity(0, 0, -parameters.gravity);
  const Eigen::Vector3d begin = state.R_GI * step.force_begin + gravity;
  const Eigen::Vector3d end = state.R_GI * step.force_end + gravity;
  state.p_GI += step.dt * state.v_GI + step.dt * step.dt * (begin / 3 + end / 6);
  state.v_GI += step.dt * 0.5 * (begin + end);
  state.R_GI = state.R_GI * step.turn;
}

void clonePose(NavigationState& state) {
  // The horizontal position is unobservable and not needed: removing it keeps the covariance bounded.
  for (const int axis : {0, 1}) {
    state.p_GI(axis) = 0;
    state.P.row(kPosition + axis).setZero();
    state.P.col(kPosition + axis).setZero();
  }
  state.R_GI = nearestRotation(state.R_GI);
  state.R_GI_clone = state.R_GI;
  state.p_GI_clone = state.p_GI;
  state.mount_clone = state.mount;
  state.zoom_clone = state.zoom;
  state.P.middleRows<6>(kCloneAttitude) = state.P.middleRows<6>(kAttitude).eval();
  state.P.middleCols<6>(kCloneAttitude) = state.P.middleCols<6>(kAttitude).eval();
}

void addError(NavigationState& state, const ErrorVector& error) {
  state.R_GI = state.R_GI * expSO3(error.segment<3>(kAttitude));
  state.p_GI += error.segment<3>(kPosition);
  state.v_GI += error.segment<3>(kVelocity);
  state.gyro_bias += error.segment<3>(kGyroBias);
  state.accel_bias += error.segment<3>(kAccelBias);
  state.R_GI_clone = state.R_GI_clone * expSO3(error.segment<3>(kCloneAttitude));
  state.p_GI_clone += error.segment<3>(kClonePosition);
  state.R_CI = expSO3(error.segment<3>(kMounting)) * state.R_CI;
}

void setCovariance(NavigationState& state, const ErrorCovariance& rest, const ErrorCovariance& noise) {
  const ErrorCovariance P = mappedCovariance(rest, state.P) + noise;
  state.P = 0.5 * (P + P.transpose());
}

bool isValid(const NavigationState& state) {
  return state.R_GI.allFinite() && state.p_GI.allFinite() && state.gyro_bias.allFinite() &&
         state.accel_bias.allFinite() && state.R_CI.allFinite() && state.R_GI_clone.allFinite() &&
         state.p_GI_clone.allFinite() && state.P.allFinite() && state.v_GI.norm() < kMaxSpeed &&
         state.P.diagonal().minCoeff() >= 0;
}

}  // namespace redbee
