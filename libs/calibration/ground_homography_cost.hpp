// Residual of the ground's homography between two frames.
//
// With n the ground's normal in G and the plane through G's origin,
//
//     m_a = -R_CaG n      h_a = n . p_GCa      R = R_CbG R_GCa      t = R_CbG (p_GCa - p_GCb)
//     H   = K_s (R + t m_a' / h_a) K_s^-1      K_s = T K, T Hartley's scaling
//     r   = L' (vec(H / h33) - vec(H_measured))      L L' = information of the measured entries
//
// H_measured with its information represents all ground points of the pair: the sum of their squared transfer
// errors is |r|^2 plus a constant, to second order around its minimum. A thousand points cost as much as
// eight.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/camera_motion.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee::calibration {

struct GroundHomographyCost {
  Eigen::Matrix3d K_scaled;
  Eigen::Matrix3d K_scaled_inverse;
  Vector8d measured;       ///< scaled entries, frame a to frame b
  Matrix8d square_root;    ///< L'
  Eigen::Vector3d rate_a;  ///< rad/s, of I in I at frame a
  Eigen::Vector3d rate_b;

  static constexpr int kResiduals = 8;

  template <typename T>
  bool operator()(const T* q_GIa, const T* p_GIa, const T* v_GIa, const T* q_GIb, const T* p_GIb,
                  const T* v_GIb, const T* q_CI, const T* p_IC, const T* shift_s, const T* tilt,
                  T* residual) const {
    const CameraAt<T> a = cameraAt(q_GIa, p_GIa, v_GIa, rate_a, q_CI, p_IC, *shift_s);
    const CameraAt<T> b = cameraAt(q_GIb, p_GIb, v_GIb, rate_b, q_CI, p_IC, *shift_s);
    const Vector3T<T> n = groundNormal(tilt);
    const Vector3T<T> m_a = -(a.q_CG * n);
    const T h_a = n.dot(a.p_GC);
    if (h_a <= T(1e-3)) return false;
    const Vector3T<T> t = b.q_CG * Vector3T<T>(a.p_GC - b.p_GC);
    const Eigen::Matrix<T, 3, 3> R = (b.q_CG * a.q_CG.conjugate()).toRotationMatrix();
    const Eigen::Matrix<T, 3, 3> euclidean = R + t * m_a.transpose() / h_a;
    const Eigen::Matrix<T, 3, 3> H = K_scaled.cast<T>() * euclidean * K_scaled_inverse.cast<T>();

    Eigen::Matrix<T, 8, 1> difference;
    for (int i = 0; i < 8; ++i) difference(i) = H(i / 3, i % 3) / H(2, 2) - measured(i);
    Eigen::Map<Eigen::Matrix<T, 8, 1>> whitened(residual);
    whitened = square_root.cast<T>() * difference;
    return true;
  }
};

}  // namespace redbee::calibration
