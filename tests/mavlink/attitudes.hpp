// Attitudes and their messages.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "redbee/geometry/time.hpp"
#include "redbee/mavlink/sensor_messages.hpp"

namespace redbee::mavlink {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

inline constexpr double kDeg = M_PI / 180;
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline const ImuTime kNow{fromSeconds(100)};

/// FRD to NED, yaw then pitch then roll.
inline Quaterniond attitude(double yaw_deg, double pitch_deg = 0, double roll_deg = 0) {
  return Quaterniond(AngleAxisd(yaw_deg * kDeg, Vector3d::UnitZ()) *
                     AngleAxisd(pitch_deg * kDeg, Vector3d::UnitY()) *
                     AngleAxisd(roll_deg * kDeg, Vector3d::UnitX()));
}
inline AttitudeQuaternion messageOf(const Quaterniond& q) {
  AttitudeQuaternion m;
  m.q1 = static_cast<float>(q.w());
  m.q2 = static_cast<float>(q.x());
  m.q3 = static_cast<float>(q.y());
  m.q4 = static_cast<float>(q.z());
  return m;
}
inline void expectNear(const Vector3d& a, const Vector3d& b, double tolerance = 1e-6) {
  EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " is not " << b.transpose();
}

}  // namespace redbee::mavlink
