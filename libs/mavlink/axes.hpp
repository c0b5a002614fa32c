// Axes. MAVLink's are forward, right, down (FRD) of the body and north, east, down (NED); ours, as in ROS
// (REP 103), are forward, left, up (FLU) and east, north, up (ENU).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace redbee::mavlink {

/// Half a turn about the forward axis: its own inverse.
inline Eigen::Vector3d fluOf(const Eigen::Vector3d& frd) { return {frd.x(), -frd.y(), -frd.z()}; }
inline Eigen::Vector3d enuOf(const Eigen::Vector3d& ned) { return {ned.y(), ned.x(), -ned.z()}; }

/// A rotation between bodies: FRD to FRD becomes FLU to FLU.
inline Eigen::Quaterniond fluRotation(const Eigen::Quaterniond& frd_from_frd) {
  return {frd_from_frd.w(), frd_from_frd.x(), -frd_from_frd.y(), -frd_from_frd.z()};
}
/// FRD to NED becomes FLU to ENU. NED's axes are ENU's after half a turn about (1, 1, 0).
inline Eigen::Quaterniond enuRotation(const Eigen::Quaterniond& ned_from_frd) {
  constexpr double kHalf = 0.70710678118654752440;
  const Eigen::Quaterniond enu_from_ned(0, kHalf, kHalf, 0);
  const Eigen::Quaterniond frd_from_flu(0, 1, 0, 0);
  return (enu_from_ned * ned_from_frd * frd_from_flu).normalized();
}

/// From w x y z; of a length that no rotation has, or not finite, std::nullopt.
inline std::optional<Eigen::Quaterniond> rotationOf(float w, float x, float y, float z) {
  const Eigen::Quaterniond q(w, x, y, z);
  const double norm = q.norm();
  constexpr double kTolerance = 0.01;  // of a float that was rounded on its way
  if (!(norm > 1 - kTolerance && norm < 1 + kTolerance)) return std::nullopt;
  return q.normalized();
}

/// Heading of a body [rad], from north to the east, of FRD to NED.
inline double headingOf(const Eigen::Quaterniond& ned_from_frd) {
  const Eigen::Vector3d forward = ned_from_frd * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace redbee::mavlink
