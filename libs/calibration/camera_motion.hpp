// Pose of the camera at an exposure, for automatic differentiation.
//
// A frame's state is at t_cam + timeshift; the exposure is at t_cam + timeshift + s, with s to be estimated.
// To first order
//
//     R_GI(s) = R_GI exp(w s)        p_GI(s) = p_GI + v_GI s
//     R_CG = R_CI R_GI(s)'           p_GC = p_GI(s) + R_GI(s) p_IC
//
// w: angular rate at the frame, without bias.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace redbee::calibration {

template <typename T>
using Vector3T = Eigen::Matrix<T, 3, 1>;

template <typename T>
struct CameraAt {
  Eigen::Quaternion<T> q_CG;
  Vector3T<T> p_GC;
};

/// Small rotation exp(phi), exact to third order: enough for a time shift of milliseconds.
template <typename T>
Eigen::Quaternion<T> smallRotation(const Vector3T<T>& phi) {
  const Vector3T<T> half = T(0.5) * phi;
  return Eigen::Quaternion<T>(T(1) - T(0.5) * half.squaredNorm(), half.x(), half.y(), half.z()).normalized();
}

/// Rotation vector of a rotation near the identity: 2 * vector part, exact to third order.
template <typename T>
Vector3T<T> smallRotationVector(const Eigen::Quaternion<T>& q) {
  const T sign = q.w() < T(0) ? T(-2) : T(2);
  return sign * q.vec();
}

template <typename T>
CameraAt<T> cameraAt(const T* q_GI, const T* p_GI, const T* v_GI, const Eigen::Vector3d& rate, const T* q_CI,
                     const T* p_IC, const T& shift_s) {
  using Quaternion = Eigen::Map<const Eigen::Quaternion<T>>;
  using Vector = Eigen::Map<const Vector3T<T>>;
  const Vector3T<T> turn = rate.cast<T>() * shift_s;
  const Eigen::Quaternion<T> q = Quaternion(q_GI) * smallRotation<T>(turn);
  const Vector3T<T> p = Vector(p_GI) + Vector(v_GI) * shift_s;
  return {Quaternion(q_CI) * q.conjugate(), p + q * Vector(p_IC)};
}

template <typename T>
Vector3T<T> groundNormal(const T* tilt) {
  return Vector3T<T>(tilt[0], tilt[1], T(1)).normalized();
}

}  // namespace redbee::calibration
