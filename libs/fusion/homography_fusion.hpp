// The Kalman filter that fuses the inertial and the visual homography of the ground (paper III.A, equations 2
// to 7; libs/README.md, "Fusion").
//
// kPropagated fuses the *step*, frame k-1 to k: the inertial homography with covariance Q against the visual
// one with P_t, two independent measurements of the same quantity; the result is then composed onto the
// anchor homography. The paper's filter (kPaper) fuses x = H_I H^{0:k-1} with covariance J P J' + Q against z
// = H_V H^{0:k-1} with P_t, as if z measured H^{0:k} absolutely. In fact z contains the same H^{0:k-1} with
// the same error, so it has no information about that error. Including the accumulated P makes the gain grow
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

  /// Processes one frame with the available inputs. If neither connects `time` to a frame of this epoch, the
  /// source is kNone and a new epoch begins at `time`; the same for a time that does not increase.
  FusedHomography step(CameraTime time, const std::optional<InertialInput>& inertial,
                       const std::optional<VisualInput>& visual);
  /// The homography from the frame at `time` to the newest one, ideal pixels; std::nullopt where the chain of
  /// steps does not reach back to it.
  std::optional<Eigen::Matrix3d> since(CameraTime time) const;

 private:
  /// Prediction and measurement of the anchor homography; the covariances are those of the step.
  struct Sources {
    std::optional<Estimate> inertial;
    std::optional<Estimate> visual;
    /// The part of visual's covariance that is of the steps between its start and the newest frame.
    Matrix8d across = Matrix8d::Zero();
  };

  /// The step of a homography from the frame at `time_previous`, which may be older than the newest frame.
  std::optional<Estimate> stepFrom(CameraTime time_previous, const Eigen::Matrix3d& H_px,
                                   const Matrix8d& covariance) const;
  Estimate ontoAnchor(const Estimate& step, const Vector8d& paper_noise) const;
  Sources anchorSources(const std::optional<InertialInput>& inertial,
                        const std::optional<VisualInput>& visual) const;
  Matrix8d toScaled(const Estimate& estimate) const;
  Matrix8d propagatedCovariance(const Eigen::Matrix3d& H_anchor) const;
  /// These update the anchor homography to the newest frame and return the step.
  Estimate advance(const Sources& sources, FusedHomography& out);
  Estimate follow(const Estimate& source);
  Estimate fuse(const Sources& sources, FusedHomography& out);
  /// An IMU that has just started may have another clock or mounting than configured: until it has agreed
  /// with vision for a second, vision is followed where they contradict each other. `step`: the time
  /// compared.
  void proveInertial(bool agrees, Duration step);
  bool isTooUncertain(const Estimate& step) const;
  Estimate stepTo(const Estimate& next) const;
  Estimate accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise,
                  const Matrix8d& covariance_anchor);
  void anchorAt(CameraTime time);
  std::optional<MeasuredStep> measuredStep(const std::optional<VisualInput>& visual) const;
  /// No estimate for this step.
  FusedHomography beginEpoch(CameraTime time);
  FusedHomography beginChain(CameraTime time);

  FusionParameters parameters_;
  int width_;
  int height_;
  ImageScaling scaling_;
  ImageScaling units_;  ///< units of the filter
  double gate_;
  int32_t epoch_ = 0;
  CameraTime time_epoch_{};  ///< its first frame
  CameraTime time_anchor_{};
  Estimate anchor_ = identityEstimate();  ///< anchor frame to the newest frame
  StepChain chain_;
  int gated_in_a_row_ = 0;
  Duration agreed_{0};  ///< by how long agreement has outweighed contradiction
  bool inertial_is_proven_ = false;
};

}  // namespace redbee
