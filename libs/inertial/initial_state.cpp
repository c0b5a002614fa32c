#include "redbee/inertial/initial_state.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/corrections.hpp"
#include "redbee/inertial/homography_measurement.hpp"

namespace redbee {
namespace {

/// Mean specific force in the orientation of the last sample.
Eigen::Vector3d meanForce(const std::vector<ImuSample>& samples, const Eigen::Vector3d& gyro_bias,
                          const Eigen::Vector3d& accel_bias) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) {
      const double dt = seconds(samples[i].time - samples[i - 1].time);
      const Eigen::Vector3d rate = 0.5 * (samples[i].gyro + samples[i - 1].gyro) - gyro_bias;
      sum = expSO3(-rate * dt) * sum;
    }
    sum += samples[i].accel - accel_bias;
  }
  return sum / static_cast<double>(samples.size());
}

double variance(double sigma) { return sigma * sigma; }

void setVariance(ErrorCovariance& P, int index, const Eigen::Vector3d& sigma) {
  P.block<3, 3>(index, index) = sigma.cwiseAbs2().asDiagonal();
}

/// The smallest rotation that turns `up` into z.
Eigen::Matrix3d righting(const Eigen::Vector3d& up) {
  return rotationBetween(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Tilt error = skew(up) (bias error + the drone's acceleration) / g, to first order.
void setTilt(NavigationState& state, const Eigen::Vector3d& force, const InertialParameters& parameters) {
  const Eigen::Vector3d up = force.norm() > 1e-3 ? force.normalized() : Eigen::Vector3d::UnitZ();
  state.R_GI = righting(up);
  const Eigen::Matrix3d by_force = skew(up) / parameters.gravity;
  const Eigen::Matrix3d bias = state.P.block<3, 3>(kAccelBias, kAccelBias);
  const Eigen::Matrix3d own = variance(parameters.gravity_sigma) * Eigen::Matrix3d::Identity();
  state.P.block<3, 3>(kAttitude, kAttitude) = by_force * (bias + own) * by_force.transpose();
  state.P.block<3, 3>(kAttitude, kAccelBias) = by_force * bias;
  state.P.block<3, 3>(kAccelBias, kAttitude) = bias * by_force.transpose();
}

/// A flight's first frame as configured.
FilterSnapshot configured(const InertialParameters& parameters) {
  const InertialExtrinsics& extrinsics = parameters.extrinsics;
  FilterSnapshot known;
  known.height_m = extrinsics.start_height_m;
  known.height_sigma_m = extrinsics.start_height_sigma_m;
  known.velocity_sigma.setConstant(parameters.start_velocity_sigma);
  known.gyro_bias = parameters.gyro_bias;
  known.gyro_bias_sigma.setConstant(parameters.gyro_bias_sigma);
  known.accel_bias = parameters.accel_bias;
  known.accel_bias_sigma.setConstant(parameters.accel_bias_sigma);
  known.R_CI = extrinsics.R_CI;
  known.R_CI_sigma.setConstant(parameters.extrinsicRotationSigma());
  return known;
}

/// Biases and mounting of `learned`, all else as configured.
FilterSnapshot sensorsOf(const FilterSnapshot& learned, const InertialParameters& parameters) {
  FilterSnapshot known = configured(parameters);
  known.gyro_bias = learned.gyro_bias;
  known.gyro_bias_sigma = learned.gyro_bias_sigma;
  known.accel_bias = learned.accel_bias;
  known.accel_bias_sigma = learned.accel_bias_sigma;
  known.R_CI = learned.R_CI;
  known.R_CI_sigma = learned.R_CI_sigma;
  return known;
}

/// Combines the known vertical and the one of the specific force.
void mergeTilt(NavigationState& state, const Eigen::Vector3d& force, const FilterSnapshot& known,
               const InertialParameters& parameters) {
  state.R_GI = righting(known.up);
  const Eigen::Matrix3d across =
      Eigen::Matrix3d::Identity() - known.up * known.up.transpose();  // yaw is free
  setVariance(state.P, kAttitude, known.up_sigma);
  state.P.block<3, 3>(kAttitude, kAttitude) =
      across * state.P.block<3, 3>(kAttitude, kAttitude).eval() * across;
  correctVertical(state, force, variance(parameters.gravity_sigma), parameters);
}

Eigen::Vector3d sigmaOf(const Eigen::Matrix3d& covariance) {
  return covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace

NavigationState initialState(CameraTime time, const std::vector<ImuSample>& before,
                             const InertialParameters& parameters,
                             const std::optional<FilterSnapshot>& learned) {
  const bool is_recent = learned && isRecent(*learned, time);
  const FilterSnapshot known = is_recent ? aged(*learned, time)
                               : learned ? sensorsOf(*learned, parameters)
                                         : configured(parameters);
  NavigationState state;
  state.P.setZero();
  state.gyro_bias = known.gyro_bias;
  state.accel_bias = known.accel_bias;
  state.R_CI = known.R_CI;
  state.v_GI = known.velocity;
  setVariance(state.P, kGyroBias, known.gyro_bias_sigma);
  setVariance(state.P, kAccelBias, known.accel_bias_sigma);
  setVariance(state.P, kMounting, known.R_CI_sigma);
  setVariance(state.P, kVelocity, known.velocity_sigma);
  state.P(kPosition + 2, kPosition + 2) = variance(known.height_sigma_m);
  const Eigen::Vector3d force = meanForce(before, state.gyro_bias, state.accel_bias);
  if (is_recent) {
    mergeTilt(state, force, known, parameters);
  } else {
    setTilt(state, force, parameters);
  }
  state.p_GI = {0, 0, known.height_m - state.R_GI.row(2) * parameters.extrinsics.p_IC};
  clonePose(state);
  return state;
}

FilterSnapshot snapshotOf(const NavigationState& state, CameraTime time, const Eigen::Vector3d& p_IC) {
  const Eigen::Matrix3d from_G = righting(state.R_GI.row(2)) * state.R_GI.transpose();
  const auto block = [&](int index) -> Eigen::Matrix3d { return state.P.block<3, 3>(index, index); };
  FilterSnapshot known;
  known.time = time;
  known.height_m = cameraHeight(state, p_IC);
  known.height_sigma_m = cameraHeightSigma(state, p_IC);
  known.up = state.R_GI.row(2).normalized();
  known.up_sigma = sigmaOf(block(kAttitude));
  known.velocity = from_G * state.v_GI;
  known.velocity_sigma = sigmaOf(from_G * block(kVelocity) * from_G.transpose());
  known.gyro_bias = state.gyro_bias;
  known.gyro_bias_sigma = sigmaOf(block(kGyroBias));
  known.accel_bias = state.accel_bias;
  known.accel_bias_sigma = sigmaOf(block(kAccelBias));
  known.R_CI = state.R_CI;
  known.R_CI_sigma = sigmaOf(block(kMounting));
  return known;
}

}  // namespace redbee
