// The Kalman filter that fuses the inertial and the visual homography of the ground (paper III.A, equations 2
// to 7; libs/README.md, "Fusion").
//
// kPropagated fuses the *step*, frame k-1 to k: the inertial homography with covariance Q against the visual
// one with P_t, two independent measurements of one thing; the result is then composed onto the anchor
// homography. The paper's recipe (kPaper) fuses x = H_I H^{0:k-1} with covariance J P J' + Q against z = H_V
// H^{0:k-1} with P_t, as though z measured H^{0:k} absolutely. It does not: z contains the same H^{0:k-1},
// with the same error, and has no information about it. Counting the accumulated P makes the gain grow
// towards vision without bound, and keeps P small while the anchor drifts. In kPropagated x_{k-1} cancels out
// of the innovation, and the anchor's covariance grows as its error does.
#pragma once

#include <cstdint>
#include <optional>

#include "redbee/fusion/estimate.hpp"
#include "redbee/fusion/fused_homography.hpp"
#include "redbee/fusion/fusion_parameters.hpp"
#include "redbee/fusion/step_chain.hpp"

namespace redbee {

class HomographyFusion {
 public:
  HomographyFusion(int width, int height, const FusionParameters& parameters);

  /// One frame with the available sources. Where neither input connects `time` to a frame of this epoch, the
  /// chain is broken: the source is kNone and a new epoch begins at `time`. A time that does not move
  /// forward is refused the same way.
  FusedHomography step(CameraTime time, const std::optional<InertialInput>& inertial,
                       const std::optional<VisualInput>& visual);

 private:
  /// Prediction and observation of the anchor homography; the covariances are the step's contribution.
  struct Sources {
    std::optional<Estimate> inertial;
    std::optional<Estimate> visual;
  };

  /// Of a homography from the frame at `time_previous`, which may lie further back than the newest.
  std::optional<Estimate> stepFrom(CameraTime time_previous, const Eigen::Matrix3d& H_px,
                                   const Matrix8d& covariance) const;
  Estimate ontoAnchor(const Estimate& step, const Vector8d& paper_noise) const;
  Sources anchorSources(const std::optional<InertialInput>& inertial,
                        const std::optional<VisualInput>& visual) const;
  Matrix8d toScaled(const Estimate& estimate) const;
  Matrix8d carriedCovariance(const Eigen::Matrix3d& H_anchor) const;
  /// These move the anchor homography to the newest frame, and return the step.
  Estimate advance(const Sources& sources, FusedHomography& out);
  Estimate follow(const Estimate& source);
  Estimate fuse(const Estimate& inertial, const Estimate& visual, FusedHomography& out);
  Estimate accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise,
                  const Matrix8d& covariance_anchor);
  void anchorAt(CameraTime time);
  FusedHomography beginChain(CameraTime time);

  FusionParameters parameters_;
  int width_;
  int height_;
  ImageScaling scaling_;
  ImageScaling units_;  ///< that the filter works in
  double gate_;
  int32_t epoch_ = 0;
  CameraTime time_anchor_{};
  Estimate anchor_ = identityEstimate();  ///< anchor frame to the newest frame
  StepChain chain_;
  int gated_in_a_row_ = 0;
};

}  // namespace redbee
