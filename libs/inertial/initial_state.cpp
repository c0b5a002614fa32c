#include "inertial/initial_state.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

/// Mean specific force in the orientation of the last sample.
Eigen::Vector3d meanForce(const std::vector<ImuSample>& samples, const Eigen::Vector3d& gyro_bias,
                          const Eigen::Vector3d& accel_bias) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) {
      const double dt = static_cast<double>(samples[i].utime - samples[i - 1].utime) * 1e-6;
      const Eigen::Vector3d rate = 0.5 * (samples[i].gyro + samples[i - 1].gyro) - gyro_bias;
      sum = expSO3(-rate * dt) * sum;
    }
    sum += samples[i].accel - accel_bias;
  }
  return sum / static_cast<double>(samples.size());
}

double square(double x) { return x * x; }

void setVariance(ErrorCovariance& P, int index, double sigma) {
  P.block<3, 3>(index, index) = square(sigma) * Eigen::Matrix3d::Identity();
}

/// Tilt error = skew(up) (bias error + the drone's acceleration) / g, to first order.
void setTilt(NavigationState& state, const Eigen::Vector3d& force, const InertialParameters& parameters) {
  const Eigen::Vector3d up = force.norm() > 1e-3 ? force.normalized() : Eigen::Vector3d::UnitZ();
  state.R_GI = Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d by_force = skew(up) / parameters.gravity;
  const Eigen::Matrix3d bias = state.P.block<3, 3>(kAccelBias, kAccelBias);
  const Eigen::Matrix3d own = square(parameters.gravity_sigma) * Eigen::Matrix3d::Identity();
  state.P.block<3, 3>(kAttitude, kAttitude) = by_force * (bias + own) * by_force.transpose();
  state.P.block<3, 3>(kAttitude, kAccelBias) = by_force * bias;
  state.P.block<3, 3>(kAccelBias, kAttitude) = bias * by_force.transpose();
}

void setPose(NavigationState& state, const std::vector<ImuSample>& before,
             const InertialParameters& parameters) {
  setTilt(state, meanForce(before, state.gyro_bias, state.accel_bias), parameters);
  const InertialExtrinsics& extrinsics = parameters.extrinsics;
  state.p_GI = {0, 0, extrinsics.start_height_m - state.R_GI.row(2) * extrinsics.p_IC};
  state.v_GI.setZero();
  setVariance(state.P, kVelocity, parameters.start_velocity_sigma);
  state.P(kPosition + 2, kPosition + 2) = square(extrinsics.start_height_sigma_m);
  clonePose(state);
}

}  // namespace

NavigationState initialState(const std::vector<ImuSample>& before, const InertialParameters& parameters) {
  NavigationState state;
  state.P.setZero();
  state.gyro_bias = parameters.gyro_bias;
  state.accel_bias = parameters.accel_bias;
  state.R_CI = parameters.extrinsics.R_CI;
  setVariance(state.P, kGyroBias, parameters.gyro_bias_sigma);
  setVariance(state.P, kAccelBias, parameters.accel_bias_sigma);
  setVariance(state.P, kMounting, parameters.extrinsic_rotation_sigma_deg * kRadiansPerDegree);
  setPose(state, before, parameters);
  return state;
}

NavigationState restartedState(const NavigationState& old, const std::vector<ImuSample>& before,
                               const InertialParameters& parameters) {
  NavigationState state = old;
  state.P.setZero();
  for (const int i : {kGyroBias, kAccelBias, kMounting}) {
    state.P.block<3, 3>(i, i) = old.P.block<3, 3>(i, i);
  }
  setPose(state, before, parameters);
  return state;
}

}  // namespace redbee
