// Rotations: exponential and logarithm of SO(3) and their derivatives.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace redbee {

/// Skew-symmetric matrix: skew(a) * b == a.cross(b).
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation matrix of the rotation vector `phi` [rad].
Eigen::Matrix3d expSO3(const Eigen::Vector3d& phi);

/// Rotation vector [rad] of a rotation matrix, its norm in [0, pi].
Eigen::Vector3d logSO3(const Eigen::Matrix3d& R);

/// Right Jacobian J_r: exp(phi + d) ~ exp(phi) exp(J_r(phi) d) for small d.
Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& phi);

/// The rotation closest to `M` in the Frobenius norm.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M);

/// The smallest rotation that turns `from` into the direction of `to`; half a turn about some axis if they
/// are opposite.
Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// True if `R` is orthonormal with determinant +1, each entry of R R' - I within `tolerance`.
bool isRotation(const Eigen::Matrix3d& R, double tolerance = 1e-6);

}  // namespace redbee
