// Residual of the IMU between two frames (Forster et al. 2017, equation 45), with gravity (0, 0, -g) in G:
//
//     r_R = log( (R exp(R_by_gyro db_g))' R_GIa' R_GIb )
//     r_v = R_GIa' (v_b - v_a + g e_z dt) - (v + v_by_gyro db_g + v_by_accel db_a)
//     r_p = R_GIa' (p_b - p_a - v_a dt + g e_z dt^2 / 2) - (p + p_by_gyro db_g + p_by_accel db_a)
//     r   = L' (r_R, r_v, r_p)      L L' = inverse of the preintegration's covariance
//
// db: bias less the bias of the preintegration.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/camera_motion.hpp"
#include "redbee/calibration/preintegration.hpp"

namespace redbee::calibration {

struct PreintegrationCost {
  Preintegration sum;
  Matrix9d square_root;  ///< L'
  double gravity;        ///< m/s^2

  static constexpr int kResiduals = 9;

  template <typename T>
  bool operator()(const T* q_GIa, const T* p_GIa, const T* v_GIa, const T* q_GIb, const T* p_GIb,
                  const T* v_GIb, const T* gyro_bias, const T* accel_bias, T* residual) const {
    using Quaternion = Eigen::Map<const Eigen::Quaternion<T>>;
    using Vector = Eigen::Map<const Vector3T<T>>;
    const Vector3T<T> d_gyro = Vector(gyro_bias) - sum.bias.gyro.cast<T>();
    const Vector3T<T> d_accel = Vector(accel_bias) - sum.bias.accel.cast<T>();
    const Vector3T<T> turn = sum.R_by_gyro.cast<T>() * d_gyro;
    const Eigen::Quaternion<T> predicted = Eigen::Quaterniond(sum.R).cast<T>() * smallRotation<T>(turn);
    const Eigen::Quaternion<T> q_IaG = Quaternion(q_GIa).conjugate();
    const T dt(sum.dt_s);
    const Vector3T<T> fall = Eigen::Vector3d(0, 0, gravity * sum.dt_s).cast<T>();
    const Vector3T<T> dv = Vector(v_GIb) - Vector(v_GIa) + fall;
    const Vector3T<T> dp = Vector(p_GIb) - Vector(p_GIa) - Vector(v_GIa) * dt + T(0.5) * dt * fall;

    Eigen::Matrix<T, 9, 1> r;
    r.template head<3>() = smallRotationVector<T>(predicted.conjugate() * (q_IaG * Quaternion(q_GIb)));
    r.template segment<3>(3) =
        q_IaG * dv - sum.v.cast<T>() - sum.v_by_gyro.cast<T>() * d_gyro - sum.v_by_accel.cast<T>() * d_accel;
    r.template tail<3>() =
        q_IaG * dp - sum.p.cast<T>() - sum.p_by_gyro.cast<T>() * d_gyro - sum.p_by_accel.cast<T>() * d_accel;
    Eigen::Map<Eigen::Matrix<T, 9, 1>> whitened(residual);
    whitened = square_root.cast<T>() * r;
    return true;
  }
};

}  // namespace redbee::calibration
