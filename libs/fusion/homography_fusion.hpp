// The Kalman filter that fuses the inertial and the visual homography of the ground (paper III.A, equations 2 to 7;
// method.md, "Fusion").
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "geometry/homography.hpp"

namespace redbee {

enum class FusionNoise {
  kPropagated,  ///< the covariances that the two homographies carry; vision's scaled by (1 + outliers / inliers)
  kPaper,       ///< the paper's constant diag(Q), diag(P_0), in pixel units, P_0 scaled by the same ratio
};

struct FusionParameters {
  FusionNoise noise = FusionNoise::kPropagated;
  Vector8d paper_Q;    ///< diagonal, pixel units (paper IV.B)
  Vector8d paper_P0;   ///< diagonal, pixel units (paper IV.B)
  double gate_probability = 0.999;  ///< of the innovation's chi-square test, 8 degrees of freedom
  int max_gated_in_a_row = 5;       ///< after so many refusals the filter believes vision and starts a new epoch
  double min_overlap = 0.3;         ///< share of the anchor frame still in view below which the filter is anchored anew
  double process_inflation = 1.0;   ///< scale of the inertial covariance when it serves as Q (kPropagated)
  FusionParameters();               ///< the paper's Q and P_0
};

struct InertialInput {
  int64_t utime_previous = 0;  ///< the frame that H starts from
  Eigen::Matrix3d H;    ///< from that frame to k, ideal pixels, h33 = 1
  Matrix8d covariance;  ///< scaled
};
struct VisualInput {
  int64_t utime_previous = 0;  ///< the frame that H starts from; may lie more than one frame back where vision skipped frames
  Eigen::Matrix3d H;    ///< frame k-1 to k, ideal pixels, h33 = 1
  Matrix8d covariance;  ///< scaled
  int inliers = 0;
  int outliers = 0;
};

enum class FusionSource { kNone, kInertial, kVisual, kFused };
const char* toString(FusionSource source);

struct FusedHomography {
  int64_t utime_previous = 0;
  int64_t utime = 0;
  FusionSource source = FusionSource::kNone;   ///< kNone: nothing is known of this pair; a new epoch begins
  int32_t epoch = 0;             ///< number of the anchor; H_anchor of two messages compose only inside one epoch
  int64_t utime_anchor = 0;      ///< frame 0 of this epoch
  Eigen::Matrix3d H_step;        ///< frame k-1 to k, ideal pixels, h33 = 1
  Matrix8d covariance_step;      ///< scaled
  Eigen::Matrix3d H_anchor;      ///< anchor frame to frame k (the paper's x_t)
  Matrix8d covariance_anchor;    ///< scaled
  bool has_innovation = false;   ///< both sources were there: the three below hold
  Vector8d innovation;           ///< scaled entries: visual minus predicted anchor homography
  Matrix8d innovation_covariance;
  double test_ratio = 0;         ///< squared Mahalanobis distance over the gate: above 1 vision was refused
  bool visual_accepted = false;  ///< vision entered the estimate
};

class HomographyFusion {
 public:
  HomographyFusion(int width, int height, const FusionParameters& parameters);

  /// One frame with what is at hand. Where neither input connects `utime` to a frame of this epoch, the chain is broken: the source is
  /// kNone and a new epoch begins at `utime`. A time that does not move forward is refused the same way.
  FusedHomography step(int64_t utime, const std::optional<InertialInput>& inertial,
                       const std::optional<VisualInput>& visual);

 private:
  struct Past {
    int64_t utime;
    Vector8d x;
    Matrix8d P;
  };
  FusionParameters parameters_;
  int width_;
  int height_;
  ImageScaling scaling_;
  bool started_ = false;
  int32_t epoch_ = 0;
  int64_t utime_anchor_ = 0;
  std::deque<Past> past_;  ///< anchor homographies (scaled) of the epoch's latest frames, newest last
  int gated_in_a_row_ = 0;
};

}  // namespace redbee
