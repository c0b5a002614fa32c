// The ground homography between the clone's frame and the current one, as a function of the filter's state.
#pragma once

#include <Eigen/Core>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/inertial_homography.hpp"

namespace redbee {

/// Motion of the camera from the clone to the current pose; p_IC is the camera centre in I [m].
PlaneMotion cameraMotion(const NavigationState& state, const Eigen::Vector3d& p_IC);

/// Derivatives of the parts of a motion by the error state; rotation and normal by left perturbations.
struct MotionJacobians {
  MeasurementJacobian<3> rotation;
  MeasurementJacobian<3> translation;
  MeasurementJacobian<3> normal;
  MeasurementJacobian<1> height;
};
MotionJacobians motionJacobians(const NavigationState& state, const PlaneMotion& motion,
                                const Eigen::Vector3d& p_IC);

/// The scaled homography's eight entries as a measurement.
struct HomographyMeasurement {
  Vector8d predicted;
  MeasurementJacobian<8> jacobian;
  Matrix8d linear_covariance;  ///< J P J'
  /// By the noise of a gimbal's angles and of a zoom's focal lengths; zero where the camera is fixed.
  Matrix8d optics_covariance;
  /// Second-order term: the product of the translation's and the normal's errors. It is negligible against J
  /// P J' except at unknown velocity: with t = 0, J does not depend on the normal, and the filter would be
  /// overconfident without this term.
  Matrix8d second_order_covariance;
};
/// `cameras`: scaled, see scaledMatrices().
HomographyMeasurement homographyMeasurement(const NavigationState& state, const PlaneMotion& motion,
                                            const MotionJacobians& jacobians, const CameraPair& cameras);

/// Of the motion's rotation and normal by left perturbations [rad^2], the noise of a gimbal's angles
/// included.
Eigen::Matrix3d rotationCovariance(const NavigationState& state, const MotionJacobians& jacobians);
Eigen::Matrix3d normalCovariance(const NavigationState& state, const MotionJacobians& jacobians);
/// Of the scaled homography, by the errors of the focal lengths of a lens that zooms.
Matrix8d zoomCovariance(const NavigationState& state, const PlaneHomographyJacobians& by);

/// Height of the camera above the ground [m], its derivative by the error state, one standard deviation [m].
double cameraHeight(const NavigationState& state, const Eigen::Vector3d& p_IC);
MeasurementJacobian<1> cameraHeightJacobian(const NavigationState& state, const Eigen::Vector3d& p_IC);
double cameraHeightSigma(const NavigationState& state, const Eigen::Vector3d& p_IC);

/// Lifts a camera that is lower than kMinCameraHeight.
void keepAboveGround(NavigationState& state, const Eigen::Vector3d& p_IC);

/// Of the clone's frame a and the current one b, as the lens stood [px].
CameraPair cameraMatrices(const NavigationState& state, const Camera& camera);
/// The same with the image scaling in front: T K.
CameraPair scaledMatrices(const NavigationState& state, const Camera& camera);

/// Fills a valid `result`, except for its times and status.
void describe(const NavigationState& state, const Camera& camera, const Eigen::Vector3d& p_IC,
              InertialHomography& result);

}  // namespace redbee
