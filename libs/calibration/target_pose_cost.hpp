// Residual of a target's pose in the camera, the target's origin being G's:
//
//     R_CT = R_CG R_GT      p_CT = -R_CG p_GC
//     r    = L' ( log(R_CT R_measured'), p_CT - p_measured )      L L' = information of the measured pose
//
// The measured pose with its information represents all corners of the frame, as in GroundHomographyCost.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/camera_motion.hpp"

namespace redbee::calibration {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct TargetPoseCost {
  Eigen::Quaterniond q_CT;  ///< measured
  Eigen::Vector3d p_CT;     ///< measured, m
  Matrix6d square_root;     ///< L', of (left perturbation of R_CT [rad], p_CT [m])
  Eigen::Vector3d rate;     ///< rad/s, of I in I at the frame

  static constexpr int kResiduals = 6;

  template <typename T>
  bool operator()(const T* q_GI, const T* p_GI, const T* v_GI, const T* q_CI, const T* p_IC, const T* shift_s,
                  const T* q_GT, T* residual) const {
    const CameraAt<T> camera = cameraAt(q_GI, p_GI, v_GI, rate, q_CI, p_IC, *shift_s);
    const Eigen::Quaternion<T> predicted = camera.q_CG * Eigen::Map<const Eigen::Quaternion<T>>(q_GT);
    Eigen::Matrix<T, 6, 1> r;
    r.template head<3>() = smallRotationVector<T>(predicted * q_CT.conjugate().cast<T>());
    r.template tail<3>() = -(camera.q_CG * camera.p_GC) - p_CT.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> whitened(residual);
    whitened = square_root.cast<T>() * r;
    return true;
  }
};

}  // namespace redbee::calibration
