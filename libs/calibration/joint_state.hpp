// The state that the joint problem estimates.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "redbee/calibration/preintegration.hpp"

namespace redbee::calibration {

/// State of the IMU at the exposure of one frame. G is upright: z up along gravity; its origin lies on the
/// ground below the first frame's camera, or at the target.
struct FrameState {
  double t_cam_s = 0;  ///< camera clock
  Eigen::Quaterniond q_GI = Eigen::Quaterniond::Identity();
  Eigen::Vector3d p_GI = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d v_GI = Eigen::Vector3d::Zero();  ///< m/s
};

struct JointState {
  std::vector<FrameState> frames;
  /// Biases, constant over stretches of time; stretch i ends where i + 1 begins.
  std::vector<Bias> biases;
  std::vector<double> bias_begin_s;  ///< camera clock
  Eigen::Quaterniond q_CI = Eigen::Quaterniond::Identity();
  Eigen::Vector3d p_IC = Eigen::Vector3d::Zero();  ///< m
  double timeshift_s = 0;                          ///< the frames' states belong to t_cam + timeshift
  double timeshift_step_s = 0;                     ///< its correction, to first order
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< the ground's normal in G is (x, y, 1), normalised
  Eigen::Quaterniond q_GT =
      Eigen::Quaterniond::Identity();  ///< target, where there is one; its origin is G's

  Eigen::Vector3d groundNormal() const { return tilt.homogeneous().normalized(); }
  /// Index of the stretch that contains this time.
  size_t biasIndex(double t_cam_s) const {
    size_t i = 0;
    while (i + 1 < bias_begin_s.size() && bias_begin_s[i + 1] <= t_cam_s) ++i;
    return i;
  }
};

}  // namespace redbee::calibration
