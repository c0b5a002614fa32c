// State and error state of the inertial filter, and their propagation by the IMU (libs/README.md, equation
// 20).
//
// Rotations carry their error on the right: R_true = R exp(error); the camera's mounting on the left:
// R_CI_true = exp(error) R_CI. All other errors are additive.
#pragma once

#include <Eigen/Core>

#include "redbee/geometry/products.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/inertial/imu_buffer.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/inertial/mount_track.hpp"

namespace redbee {

/// Standard deviation of a drone's motion while no sensor measures it.
constexpr double kUnknownRate = 0.3;          ///< rad/s
constexpr double kUnknownAcceleration = 2.0;  ///< m/s^2
constexpr double kMinCameraHeight = 0.05;     ///< m: lower bound

/// Index of each part of the error in its vector.
enum ErrorIndex {
  kAttitude = 0,        ///< rad, in I
  kPosition = 3,        ///< m, in G
  kVelocity = 6,        ///< m/s, in G
  kGyroBias = 9,        ///< rad/s
  kAccelBias = 12,      ///< m/s^2
  kCloneAttitude = 15,  ///< rad, in I at the previous frame
  kClonePosition = 18,  ///< m, in G
  kMounting = 21,       ///< rad, in C: error of the calibrated R_CI
  kErrorSize = 24,
};
using ErrorCovariance = Eigen::Matrix<double, kErrorSize, kErrorSize>;
using ErrorVector = Eigen::Matrix<double, kErrorSize, 1>;
template <int kRows>
using MeasurementJacobian = Eigen::Matrix<double, kRows, kErrorSize>;

struct NavigationState {
  Eigen::Matrix3d R_GI;
  Eigen::Vector3d p_GI;  ///< m; horizontally only the difference to the clone is meaningful
  Eigen::Vector3d v_GI;  ///< m/s
  Eigen::Vector3d gyro_bias;
  Eigen::Vector3d accel_bias;
  Eigen::Matrix3d R_GI_clone;  ///< at the previous frame
  Eigen::Vector3d p_GI_clone;
  Eigen::Matrix3d R_CI;  ///< the mounting at rest: the camera against its mount
  ErrorCovariance P;
  MountRotation mount;  ///< against the IMU; a gimbal turns it
  MountRotation mount_clone;
  Zoom zoom;  ///< of the lens
  Zoom zoom_clone;

  Eigen::Matrix3d cameraRotation() const { return R_CI * mount.R_MI; }  ///< IMU to camera
  Eigen::Matrix3d cameraRotationClone() const { return R_CI * mount_clone.R_MI; }
  bool isMountKnown() const { return mount.is_known && mount_clone.is_known; }
};

struct PropagationParameters {
  ImuNoise noise;
  double gravity;    ///< m/s^2
  double max_gap_s;  ///< in a longer gap the motion is treated as unknown
};

/// Integrates from one knot to the next: second order in the step, so that vibration of the airframe, at a
/// quarter of the sampling rate and above, does not bias the velocity.
void propagate(NavigationState& state, const ImuKnot& from, const ImuKnot& to,
               const PropagationParameters& parameters);

/// Clones the current pose and moves the origin of G to the ground point below it.
void clonePose(NavigationState& state);

/// Adds an estimated error to the state.
void addError(NavigationState& state, const ErrorVector& error);

/// P <- rest P rest' + noise.
void setCovariance(NavigationState& state, const ErrorCovariance& rest, const ErrorCovariance& noise);

/// Kalman update in Joseph's form. `innovation` = measured - predicted; S_inverse of its covariance H P H' +
/// R.
template <int kRows>
void update(NavigationState& state, const MeasurementJacobian<kRows>& H,
            const Eigen::Matrix<double, kRows, 1>& innovation, const Eigen::Matrix<double, kRows, kRows>& R,
            const Eigen::Matrix<double, kRows, kRows>& S_inverse) {
  const Eigen::Matrix<double, kErrorSize, kRows> gain = product(productTransposed(state.P, H), S_inverse);
  const ErrorCovariance rest = ErrorCovariance::Identity() - product(gain, H);
  setCovariance(state, rest, productTransposed(product(gain, R), gain));
  addError(state, gain * innovation);
}

bool isValid(const NavigationState& state);

}  // namespace redbee
