// The fusion's estimate for a pair of frames.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

enum class FusionSource { kNone, kInertial, kVisual, kFused };
const char* toString(FusionSource source);

/// Frame k-1 to k, ideal pixels, h33 = 1.
struct MeasuredStep {
  Eigen::Matrix3d H;
  Matrix8d covariance;  ///< scaled
};

struct FusedHomography {
  CameraTime time_previous{};
  CameraTime time{};
  FusionSource source = FusionSource::kNone;  ///< kNone: no estimate for this pair; a new epoch begins
  int32_t epoch = 0;         ///< number of the anchor; H_anchor of two messages compose only inside one epoch
  CameraTime time_anchor{};  ///< frame 0 of this epoch
  Eigen::Matrix3d H_step;    ///< frame k-1 to k, ideal pixels, h33 = 1
  Matrix8d covariance_step;  ///< scaled
  Eigen::Matrix3d H_anchor;  ///< anchor frame to frame k (the paper's x_t)
  Matrix8d covariance_anchor;              ///< scaled
  bool has_innovation = false;             ///< both sources were available: the three members below are valid
  Vector8d innovation = Vector8d::Zero();  ///< scaled entries: visual minus predicted anchor homography
  Matrix8d innovation_covariance = Matrix8d::Zero();
  double test_ratio = 0;         ///< squared Mahalanobis distance over the gate; above 1 vision is rejected
  bool visual_accepted = false;  ///< vision contributes to the estimate
  /// Vision's homography, accepted or not; where it starts at an earlier frame, what remains of it after the
  /// steps until k-1.
  std::optional<MeasuredStep> visual_step;
};

}  // namespace redbee
