#include "redbee/inertial/homography_measurement.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/products.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

/// Scaled units: keeps the homography's covariance invertible at rest.
constexpr double kVarianceFloor = 1e-12;

/// Covariance of (translation error) (normal error)' / h in the homography's entries, the two assumed
/// independent: the sum over their principal axes.
Matrix8d productCovariance(const CameraPair& cameras, const PlaneMotion& motion,
                           const Eigen::Matrix3d& translation, const Eigen::Matrix3d& normal) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shifts(translation);
  Matrix8d sum = Matrix8d::Zero();
  for (int i = 0; i < 3; ++i) {
    PlaneMotion shifted = motion;
    shifted.t_ba = std::sqrt(std::max(0.0, shifts.eigenvalues()(i))) * shifts.eigenvectors().col(i);
    const Eigen::Matrix<double, 8, 3> by_normal = planeHomographyJacobians(cameras, shifted).by_normal;
    sum += by_normal * normal * by_normal.transpose();
  }
  return sum;
}

/// By the errors at the two frames of the mount's angles, which turn the cameras, and of the focal lengths.
Matrix8d opticsCovariance(const NavigationState& state, const PlaneMotion& motion,
                          const PlaneHomographyJacobians& by) {
  using Jacobian = Eigen::Matrix<double, 8, 3>;
  const Jacobian at_b = by.by_rotation - by.by_translation * skew(motion.t_ba);
  const Jacobian at_a = by.by_normal - by.by_rotation * motion.R_ba;
  return state.mount.variance * (at_b * at_b.transpose()) +
         state.mount_clone.variance * (at_a * at_a.transpose()) + zoomCovariance(state, by);
}

}  // namespace

PlaneMotion cameraMotion(const NavigationState& state, const Eigen::Vector3d& p_IC) {
  const Eigen::Matrix3d R_CbG = state.cameraRotation() * state.R_GI.transpose();
  const Eigen::Matrix3d R_CaG = state.cameraRotationClone() * state.R_GI_clone.transpose();
  const Eigen::Vector3d p_GCa = state.p_GI_clone + state.R_GI_clone * p_IC;
  const Eigen::Vector3d p_GCb = state.p_GI + state.R_GI * p_IC;
  return {R_CbG * R_CaG.transpose(), R_CbG * (p_GCa - p_GCb), -R_CaG.col(2), p_GCa.z()};
}

MotionJacobians motionJacobians(const NavigationState& state, const PlaneMotion& motion,
                                const Eigen::Vector3d& p_IC) {
  const Eigen::Matrix3d R_CbI = state.cameraRotation(), R_CaI = state.cameraRotationClone();
  const Eigen::Matrix3d R_CbG = R_CbI * state.R_GI.transpose();
  const Eigen::Matrix3d lever_a = -state.R_GI_clone * skew(p_IC);  // camera centre a by the clone's attitude
  const Eigen::Vector3d a_in_b =
      state.R_GI.transpose() * (state.p_GI_clone + state.R_GI_clone * p_IC - state.p_GI);
  MotionJacobians J;
  J.rotation.setZero();
  J.rotation.middleCols<3>(kAttitude) = -R_CbI;
  J.rotation.middleCols<3>(kCloneAttitude) = motion.R_ba * R_CaI;
  J.rotation.middleCols<3>(kMounting) = Eigen::Matrix3d::Identity() - motion.R_ba;
  J.translation.setZero();
  J.translation.middleCols<3>(kAttitude) = R_CbI * skew(a_in_b);
  J.translation.middleCols<3>(kPosition) = -R_CbG;
  J.translation.middleCols<3>(kCloneAttitude) = R_CbG * lever_a;
  J.translation.middleCols<3>(kClonePosition) = R_CbG;
  J.translation.middleCols<3>(kMounting) = -skew(motion.t_ba);
  J.normal.setZero();
  J.normal.middleCols<3>(kCloneAttitude) = -R_CaI;
  J.normal.middleCols<3>(kMounting).setIdentity();
  J.height.setZero();
  J.height.middleCols<3>(kCloneAttitude) = lever_a.row(2);
  J.height(kClonePosition + 2) = 1;
  return J;
}

HomographyMeasurement homographyMeasurement(const NavigationState& state, const PlaneMotion& motion,
                                            const MotionJacobians& jacobians, const CameraPair& cameras) {
  const PlaneHomographyJacobians by = planeHomographyJacobians(cameras, motion);
  HomographyMeasurement z;
  z.predicted = toVector(planeHomography(cameras, motion));
  z.jacobian = product(by.by_rotation, jacobians.rotation) +
               product(by.by_translation, jacobians.translation) + product(by.by_normal, jacobians.normal) +
               by.by_height * jacobians.height;
  z.linear_covariance = mappedCovariance(z.jacobian, state.P);
  z.optics_covariance = opticsCovariance(state, motion, by);
  z.second_order_covariance =
      productCovariance(cameras, motion, mappedCovariance(jacobians.translation, state.P),
                        mappedCovariance(jacobians.normal, state.P));
  return z;
}

Eigen::Matrix3d rotationCovariance(const NavigationState& state, const MotionJacobians& jacobians) {
  const double mounts = state.mount.variance + state.mount_clone.variance;
  const Eigen::Matrix3d own = mappedCovariance(jacobians.rotation, state.P);
  // Within a fraction of a millisecond it is so small that what is rounded of the attitude's shows.
  return 0.5 * (own + own.transpose()) + mounts * Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d normalCovariance(const NavigationState& state, const MotionJacobians& jacobians) {
  return mappedCovariance(jacobians.normal, state.P) +
         state.mount_clone.variance * Eigen::Matrix3d::Identity();
}

double cameraHeight(const NavigationState& state, const Eigen::Vector3d& p_IC) {
  return state.p_GI.z() + state.R_GI.row(2) * p_IC;
}

MeasurementJacobian<1> cameraHeightJacobian(const NavigationState& state, const Eigen::Vector3d& p_IC) {
  MeasurementJacobian<1> J = MeasurementJacobian<1>::Zero();
  J.middleCols<3>(kAttitude) = -state.R_GI.row(2) * skew(p_IC);
  J(kPosition + 2) = 1;
  return J;
}

double cameraHeightSigma(const NavigationState& state, const Eigen::Vector3d& p_IC) {
  const MeasurementJacobian<1> J = cameraHeightJacobian(state, p_IC);
  return std::sqrt((J * state.P * J.transpose()).value());
}

void keepAboveGround(NavigationState& state, const Eigen::Vector3d& p_IC) {
  const double missing = kMinCameraHeight - cameraHeight(state, p_IC);
  if (missing <= 0) return;
  state.p_GI.z() += missing;
  state.p_GI_clone.z() += missing;
}

Matrix8d zoomCovariance(const NavigationState& state, const PlaneHomographyJacobians& by) {
  return state.zoom.variance * (by.by_zoom_b * by.by_zoom_b.transpose()) +
         state.zoom_clone.variance * (by.by_zoom_a * by.by_zoom_a.transpose());
}

CameraPair cameraMatrices(const NavigationState& state, const Camera& camera) {
  return {zoomed(camera.K(), state.zoom_clone.value), zoomed(camera.K(), state.zoom.value)};
}

CameraPair scaledMatrices(const NavigationState& state, const Camera& camera) {
  const Eigen::Matrix3d T = ImageScaling(camera.ideal().width, camera.ideal().height).T;
  const CameraPair cameras = cameraMatrices(state, camera);
  return {T * cameras.K_a, T * cameras.K_b};
}

void describe(const NavigationState& state, const Camera& camera, const Eigen::Vector3d& p_IC,
              InertialHomography& result) {
  result.motion = cameraMotion(state, p_IC);
  result.H = planeHomography(cameraMatrices(state, camera), result.motion);
  const MotionJacobians J = motionJacobians(state, result.motion, p_IC);
  const HomographyMeasurement z =
      homographyMeasurement(state, result.motion, J, scaledMatrices(state, camera));
  const Matrix8d covariance = z.linear_covariance + z.optics_covariance + z.second_order_covariance +
                              kVarianceFloor * Matrix8d::Identity();
  result.covariance = 0.5 * (covariance + covariance.transpose());
  result.rotation_covariance = rotationCovariance(state, J);
  result.direction_of_gravity = -(state.cameraRotation() * state.R_GI.transpose()).col(2);
  result.height_m = cameraHeight(state, p_IC);
  result.height_sigma_m = cameraHeightSigma(state, p_IC);
}

}  // namespace redbee
