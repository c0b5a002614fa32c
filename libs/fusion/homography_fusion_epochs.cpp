// Where the fusion's chain and its anchors begin.
#include "redbee/fusion/homography_fusion.hpp"

namespace redbee {
namespace {

constexpr double kUnknownVariance = 1.0;  // scaled units: half the image's width

}  // namespace

void HomographyFusion::anchorAt(CameraTime time) {
  ++epoch_;
  time_anchor_ = time;
  anchor_ = identityEstimate();
}

std::optional<MeasuredStep> HomographyFusion::measuredStep(const std::optional<VisualInput>& visual) const {
  if (!visual || visual->inliers <= 0) return std::nullopt;
  const Matrix8d covariance = measurementCovariance(*visual, parameters_);
  const std::optional<Estimate> step = stepFrom(visual->time_previous, visual->H, covariance);
  if (!step) return std::nullopt;
  if (visual->time_previous == chain_.newest()) return MeasuredStep{visual->H, covariance};
  const MeasuredStep measured{units_.unscale(step->H), toScaled(*step)};
  // Across steps that are not known nothing is measured.
  if (!isUsable(measured.H) || !isInformative(measured.covariance)) return std::nullopt;
  return measured;
}

FusedHomography HomographyFusion::beginChain(CameraTime time) {
  FusedHomography out = beginEpoch(time);
  chain_.beginAt(time);
  return out;
}

FusedHomography HomographyFusion::beginEpoch(CameraTime time) {
  FusedHomography out;
  out.time_previous = time;
  if (!chain_.empty()) {
    out.time_previous = chain_.newest() == time ? chain_.secondNewest() : chain_.newest();
    ++epoch_;
  }
  time_epoch_ = time_anchor_ = time;
  anchor_ = identityEstimate();
  gated_in_a_row_ = 0;

  out.time = time;
  out.epoch = epoch_;
  out.time_anchor = time;
  out.H_step.setIdentity();
  out.covariance_step = kUnknownVariance * Matrix8d::Identity();
  out.H_anchor.setIdentity();
  out.covariance_anchor.setZero();
  return out;
}

}  // namespace redbee
