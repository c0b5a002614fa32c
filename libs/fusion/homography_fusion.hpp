// The Kalman filter that fuses the inertial and the visual homography of the ground (paper III.A, equations 2
// to 7; method.md, "Fusion").
//
// kPropagated fuses the *step*, frame k-1 to k: the inertial homography with covariance Q against the visual
// one with P_t, two independent measurements of one thing; the result is then composed onto the anchor
// homography. The paper's recipe (kPaper) fuses x = H_I H^{0:k-1} with covariance J P J' + Q against z = H_V
// H^{0:k-1} with P_t, as though z measured H^{0:k} absolutely. It does not: z holds the same H^{0:k-1}, with
// the same error, and says nothing about it. Counting the accumulated P makes the gain grow towards vision
// without end, and lets P stay small while the anchor drifts. In kPropagated x_{k-1} cancels out of the
// innovation, and the anchor's covariance grows as its error does.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "geometry/homography.hpp"

namespace redbee {

enum class FusionNoise {
  kPropagated,  ///< the covariances that the two homographies carry; vision's scaled by (1 + outliers /
                ///< inliers)
  kPaper,       ///< the paper's constant diag(Q), diag(P_0), in pixel units, P_0 scaled by the same ratio
};

struct FusionParameters {
  FusionNoise noise = FusionNoise::kPropagated;
  Vector8d paper_Q;                 ///< diagonal, pixel units (paper IV.B)
  Vector8d paper_P0;                ///< diagonal, pixel units (paper IV.B)
  double gate_probability = 0.999;  ///< of the innovation's chi-square test, 8 degrees of freedom
  int max_gated_in_a_row = 5;  ///< after so many refusals the filter believes vision and starts a new epoch
  double min_overlap =
      0.3;  ///< share of the anchor frame still in view below which the filter is anchored anew
  /// Scale of vision's covariance (kPropagated): the ground is only roughly a plane, and relief that passes
  /// for ground is a bias that no residual shows. 8 makes a homography over ordinary relief (trees, kerbs) as
  /// uncertain as it is found to be.
  double visual_inflation = 8.0;
  double process_inflation = 1.0;  ///< scale of the inertial covariance when it serves as Q (kPropagated)
  FusionParameters();              ///< the paper's Q and P_0
};

struct InertialInput {
  int64_t utime_previous = 0;  ///< the frame that H starts from
  Eigen::Matrix3d H;           ///< from that frame to k, ideal pixels, h33 = 1
  Matrix8d covariance;         ///< scaled
};
struct VisualInput {
  int64_t utime_previous =
      0;  ///< the frame that H starts from; may lie more than one frame back where vision skipped frames
  Eigen::Matrix3d H;    ///< frame k-1 to k, ideal pixels, h33 = 1
  Matrix8d covariance;  ///< scaled
  int inliers = 0;
  int outliers = 0;
};

/// 1 + outliers / inliers: what vision's noise grows by (equation 7).
double visualNoiseRatio(int inliers, int outliers);

enum class FusionSource { kNone, kInertial, kVisual, kFused };
const char* toString(FusionSource source);

struct FusedHomography {
  int64_t utime_previous = 0;
  int64_t utime = 0;
  FusionSource source = FusionSource::kNone;  ///< kNone: nothing is known of this pair; a new epoch begins
  int32_t epoch = 0;         ///< number of the anchor; H_anchor of two messages compose only inside one epoch
  int64_t utime_anchor = 0;  ///< frame 0 of this epoch
  Eigen::Matrix3d H_step;    ///< frame k-1 to k, ideal pixels, h33 = 1
  Matrix8d covariance_step;  ///< scaled
  Eigen::Matrix3d H_anchor;  ///< anchor frame to frame k (the paper's x_t)
  Matrix8d covariance_anchor;              ///< scaled
  bool has_innovation = false;             ///< both sources were there: the three below hold
  Vector8d innovation = Vector8d::Zero();  ///< scaled entries: visual minus predicted anchor homography
  Matrix8d innovation_covariance = Matrix8d::Zero();
  double test_ratio = 0;         ///< squared Mahalanobis distance over the gate: above 1 vision was refused
  bool visual_accepted = false;  ///< vision entered the estimate
};

class HomographyFusion {
 public:
  HomographyFusion(int width, int height, const FusionParameters& parameters);

  /// One frame with what is at hand. Where neither input connects `utime` to a frame of this epoch, the chain
  /// is broken: the source is kNone and a new epoch begins at `utime`. A time that does not move forward is
  /// refused the same way.
  FusedHomography step(int64_t utime, const std::optional<InertialInput>& inertial,
                       const std::optional<VisualInput>& visual);

 private:
  /// A homography in the filter's working units (scaled; kPaper: pixels), with its covariance.
  struct Estimate {
    Eigen::Matrix3d H;
    Matrix8d P;
  };
  struct Past {
    int64_t utime;
    Estimate step;  ///< from the frame before
  };
  /// Prediction and observation of the anchor homography; the noises are those that the step added to it.
  struct Sources {
    std::optional<Estimate> inertial;
    std::optional<Estimate> visual;
  };

  std::optional<Estimate> stepFrom(int64_t utime_previous, const Eigen::Matrix3d& H_px,
                                   const Matrix8d& covariance) const;
  Estimate ontoAnchor(const Estimate& step, const Vector8d& paper_noise) const;
  Sources anchorSources(const std::optional<InertialInput>& inertial,
                        const std::optional<VisualInput>& visual) const;
  Matrix8d toScaled(const Estimate& estimate) const;
  Matrix8d carriedCovariance(const Eigen::Matrix3d& H_anchor) const;
  void follow(const Estimate& source);
  void fuse(const Estimate& inertial, const Estimate& visual, FusedHomography& out);
  void accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise, const Matrix8d& covariance_anchor);
  void anchorAt(int64_t utime);
  FusedHomography beginChain(int64_t utime);
  double overlap() const;

  FusionParameters parameters_;
  int width_;
  int height_;
  ImageScaling scaling_;
  ImageScaling units_;  ///< that the filter works in
  double gate_;
  bool started_ = false;
  int32_t epoch_ = 0;
  int64_t utime_anchor_ = 0;
  Estimate anchor_;        ///< anchor frame to the newest frame
  std::deque<Past> past_;  ///< the latest frames of this chain, newest last
  int gated_in_a_row_ = 0;
};

}  // namespace redbee
