// How the camera's rotation as vision saw it differs from the IMU's.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/inertial/error_state.hpp"

namespace redbee {

/// Of one pair of frames a, b.
struct RotationDifference {
  Eigen::Vector3d difference;  ///< rad, vision minus IMU: left perturbation of the IMU's R_ba
  Eigen::Matrix3d covariance;  ///< rad^2, by the errors of both
};

/// The rotation that, with any translation, explains what `observed` differs from the motion's homography; so
/// neither the filter's velocity nor its height counts. `observed`: vec of the scaled homography from vision,
/// with its covariance, that of the focal lengths' errors included; `cameras`: scaled, T K. The covariances
/// of the motion's rotation and normal are by left perturbations [rad^2]. std::nullopt if vision's covariance
/// is singular.
std::optional<RotationDifference> rotationDifference(const CameraPair& cameras, const PlaneMotion& motion,
                                                     const Eigen::Matrix3d& rotation_covariance,
                                                     const Eigen::Matrix3d& normal_covariance,
                                                     const Vector8d& observed,
                                                     const Matrix8d& observed_covariance);

/// The same between the filter's clone and its current pose. `H`: ideal pixels; `covariance`: scaled.
std::optional<RotationDifference> rotationDifference(const NavigationState& state, const Camera& camera,
                                                     const Eigen::Vector3d& p_IC, const Eigen::Matrix3d& H,
                                                     const Matrix8d& covariance);

}  // namespace redbee
