// Inputs of the fusion and their noise.
#pragma once

#include <Eigen/Core>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"

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
  int max_gated_in_a_row = 5;       ///< after so many rejections vision is accepted and a new epoch begins
  double min_overlap = 0.3;  ///< fraction of the anchor frame still in view below which a new epoch begins
  /// Scale of vision's covariance (kPropagated): the ground is only roughly a plane, and relief within the
  /// inlier threshold is a bias that residuals do not show. With 8 the covariance over ordinary relief
  /// (trees, kerbs) is consistent with the measured error.
  double visual_inflation = 8.0;
  double process_inflation = 1.0;  ///< scale of the inertial covariance when it serves as Q (kPropagated)
  FusionParameters();              ///< the paper's Q and P_0
};

struct InertialInput {
  CameraTime time_previous{};  ///< the frame that H starts from
  Eigen::Matrix3d H;           ///< from that frame to k, ideal pixels, h33 = 1
  Matrix8d covariance;         ///< scaled
};
struct VisualInput {
  /// The frame that H starts from; more than one frame back if vision skipped frames.
  CameraTime time_previous{};
  Eigen::Matrix3d H;    ///< from that frame to k, ideal pixels, h33 = 1
  Matrix8d covariance;  ///< scaled
  int inliers = 0;
  int outliers = 0;
};

/// 1 + outliers / inliers: scale of vision's covariance (equation 7).
double visualNoiseRatio(const VisualInput& visual);
/// Vision's covariance scaled by that ratio and by visual_inflation, as used here and by the inertial filter.
Matrix8d measurementCovariance(const VisualInput& visual, const FusionParameters& parameters);

}  // namespace redbee
