// Residual of a measured height of the camera above the ground, tau seconds after the nearest frame's state:
//
//     r = (n . (p_GI + v_GI tau + R_GI p_IC) - h) / sigma
// At 24 frames per second |tau| is below 21 ms; the neglected acceleration is below a millimetre at 3 m/s^2.
#pragma once

#include <Eigen/Core>

#include "redbee/calibration/camera_motion.hpp"

namespace redbee::calibration {

struct AltitudeCost {
  double height_m;
  double sigma_m;
  double tau_s;  ///< IMU clock

  static constexpr int kResiduals = 1;

  template <typename T>
  bool operator()(const T* q_GI, const T* p_GI, const T* v_GI, const T* p_IC, const T* tilt,
                  T* residual) const {
    using Vector = Eigen::Map<const Vector3T<T>>;
    const Vector3T<T> arm = Eigen::Map<const Eigen::Quaternion<T>>(q_GI) * Vector(p_IC);
    const Vector3T<T> p_GC = Vector(p_GI) + Vector(v_GI) * T(tau_s) + arm;
    residual[0] = (groundNormal(tilt).dot(p_GC) - T(height_m)) / T(sigma_m);
    return true;
  }
};

}  // namespace redbee::calibration
