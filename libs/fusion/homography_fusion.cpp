#include "redbee/fusion/homography_fusion.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "redbee/fusion/overlap.hpp"
#include "redbee/fusion/transfer_sigma.hpp"
#include "redbee/fusion/working_units.hpp"
#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/products.hpp"
#include "redbee/geometry/small_decompositions.hpp"

namespace redbee {
namespace {

/// A step with a larger transfer sigma is useless at pixel level. An inertial filter whose velocity vision
/// has not yet observed is off by ten pixels, one that lost vision a second ago by tenths.
constexpr double kMaxStepSigma_px = 2;
/// Time by which the steps that agree must outweigh those that do not, threefold, before the IMU has
/// precedence where the two contradict each other.
constexpr Duration kProven = std::chrono::seconds(1);
constexpr int kContradictionWeight = 3;
constexpr Duration kMostOfOneStep =
    std::chrono::milliseconds(250);       ///< a step across lost frames is one test, and one correction
constexpr double kUnknownVariance = 1.0;  // scaled units: half the image's width

}  // namespace

HomographyFusion::HomographyFusion(int width, int height, const FusionParameters& parameters)
    : parameters_(parameters),
      width_(width),
      height_(height),
      scaling_(width, height),
      units_(workingUnits(scaling_, parameters.noise)),
      gate_(chiSquareQuantile(parameters.gate_probability, 8)) {}

FusedHomography HomographyFusion::step(CameraTime time, const std::optional<InertialInput>& inertial,
                                       const std::optional<VisualInput>& visual) {
  if (chain_.empty() || time <= chain_.newest()) return beginChain(time);
  const Sources sources = anchorSources(inertial, visual);
  if (!sources.inertial && !sources.visual) return beginChain(time);

  FusedHomography out;
  out.visual_step = measuredStep(visual);
  out.time_previous = chain_.newest();
  out.time = time;
  const Estimate step = advance(sources, out);
  if (!isUsable(step) || !isUsable(anchor_)) return beginChain(time);
  // The paper's constant noise is not an estimate of this step's error.
  const bool knows_its_error = parameters_.noise == FusionNoise::kPropagated;
  if (knows_its_error && transferSigma(step.H, step.P, width_, height_) > kMaxStepSigma_px) {
    // The chain goes on, so that a homography of vision across this frame still measures the next step.
    FusedHomography none = beginEpoch(time);
    none.visual_step = out.visual_step;
    chain_.append(time, step);
    return none;
  }
  chain_.append(time, step);
  if (overlap(units_.unscale(anchor_.H), width_, height_) < parameters_.min_overlap) anchorAt(time);

  out.epoch = epoch_;
  out.time_anchor = time_anchor_;
  out.H_step = units_.unscale(step.H);
  out.covariance_step = toScaled(step);
  out.H_anchor = units_.unscale(anchor_.H);
  out.covariance_anchor = toScaled(anchor_);
  return out;
}

std::optional<Eigen::Matrix3d> HomographyFusion::since(CameraTime time) const {
  const std::optional<Estimate> steps = chain_.since(time);
  if (!steps || !isUsable(steps->H)) return std::nullopt;
  return units_.unscale(steps->H);
}

Estimate HomographyFusion::advance(const Sources& sources, FusedHomography& out) {
  if (sources.inertial && sources.visual) return fuse(sources, out);
  if (sources.inertial) {
    out.source = FusionSource::kInertial;
    return follow(*sources.inertial);
  }
  out.source = FusionSource::kVisual;
  out.visual_accepted = true;
  gated_in_a_row_ = 0;
  return follow(*sources.visual);
}

std::optional<Estimate> HomographyFusion::stepFrom(CameraTime time_previous, const Eigen::Matrix3d& H_px,
                                                   const Matrix8d& covariance) const {
  if (!isUsable(H_px) || !isCovariance(covariance)) return std::nullopt;
  const Eigen::Matrix3d H = units_.scale(H_px);
  if (!isUsable(H)) return std::nullopt;
  return chain_.stepOf(time_previous, {H, covariance});
}

/// The step composed onto the anchor homography, with the covariance that the step adds: equation 2.
Estimate HomographyFusion::ontoAnchor(const Estimate& step, const Vector8d& paper_noise) const {
  const Eigen::Matrix3d H = normaliseHomography(step.H * anchor_.H);
  if (parameters_.noise == FusionNoise::kPaper) return {H, paper_noise.asDiagonal()};
  return {H, transformed(composeJacobians(step.H, anchor_.H).by_left, step.P)};
}

HomographyFusion::Sources HomographyFusion::anchorSources(const std::optional<InertialInput>& inertial,
                                                          const std::optional<VisualInput>& visual) const {
  Sources sources;
  if (inertial) {
    std::optional<Estimate> step =
        stepFrom(inertial->time_previous, inertial->H, parameters_.process_inflation * inertial->covariance);
    if (step) sources.inertial = ontoAnchor(*step, parameters_.paper_Q);
  }
  if (visual && visual->inliers > 0 && visual->outliers >= 0) {
    std::optional<Estimate> step =
        stepFrom(visual->time_previous, visual->H, measurementCovariance(*visual, parameters_));
    if (step) sources.visual = ontoAnchor(*step, visualNoiseRatio(*visual) * parameters_.paper_P0);
    const bool is_across = parameters_.noise == FusionNoise::kPropagated &&
                           visual->time_previous < chain_.newest() &&
                           chain_.newest() - visual->time_previous <= kMostOfOneStep;
    if (is_across) step = stepFrom(visual->time_previous, visual->H, Matrix8d::Zero());
    if (is_across && step) sources.across = ontoAnchor(*step, Vector8d::Zero()).P;
  }
  return sources;
}

/// Covariance in the units of the interface.
Matrix8d HomographyFusion::toScaled(const Estimate& estimate) const {
  if (parameters_.noise != FusionNoise::kPaper) return estimate.P;
  const Eigen::Matrix3d& T_inverse = scaling_.T_inverse;
  const Matrix8d by_entries =
      product(composeJacobians(scaling_.T, normaliseHomography(estimate.H * T_inverse)).by_right,
              composeJacobians(estimate.H, T_inverse).by_left);
  return transformed(by_entries, estimate.P);
}

/// The error of the last anchor homography, propagated to this one.
Matrix8d HomographyFusion::propagatedCovariance(const Eigen::Matrix3d& H_anchor) const {
  const Eigen::Matrix3d step = normaliseHomography(H_anchor * anchor_.H.inverse());
  return transformed(composeJacobians(step, anchor_.H).by_right, anchor_.P);
}

Estimate HomographyFusion::follow(const Estimate& source) {
  return accept(source.H, source.P, propagatedCovariance(source.H) + source.P);
}

Estimate HomographyFusion::fuse(const Sources& sources, FusedHomography& out) {
  const Estimate &inertial = *sources.inertial, &visual = *sources.visual;
  const bool paper = parameters_.noise == FusionNoise::kPaper;
  const Matrix8d propagated = propagatedCovariance(inertial.H);
  const Matrix8d prior = paper ? Matrix8d(propagated + inertial.P) : inertial.P;
  const Matrix8d S = symmetric(prior + visual.P);
  const LdltFactors factors(S);
  out.has_innovation = true;
  const Vector8d innovation = toVector(visual.H) - toVector(inertial.H);
  out.test_ratio = innovation.dot(factors.solve(innovation)) / gate_;
  out.innovation = toVector(scaling_.scale(units_.unscale(visual.H))) -
                   toVector(scaling_.scale(units_.unscale(inertial.H)));
  out.innovation_covariance = toScaled({inertial.H, S});

  const bool agrees = factors.isPositive() && out.test_ratio <= 1;
  proveInertial(agrees, out.time - out.time_previous);
  if (!agrees && inertial_is_proven_ && ++gated_in_a_row_ <= parameters_.max_gated_in_a_row) {
    out.source = FusionSource::kInertial;
    return follow(inertial);
  }
  out.visual_accepted = true;
  gated_in_a_row_ = 0;
  if (!agrees) {
    out.source = FusionSource::kVisual;
    Estimate step = follow(visual);
    anchorAt(out.time);
    return step;
  }
  out.source = FusionSource::kFused;
  // What vision skipped it has measured with this step: their errors are corrected together, so that the way
  // across is as good as one step.
  const Matrix8d gain = factors.solve(Matrix8d(prior + sources.across)).transpose();
  const Matrix8d rest = Matrix8d::Identity() - gain;
  const Eigen::Matrix3d H = fromVector(toVector(inertial.H) + gain * innovation);
  // The step's error contains no part of the propagated error: both sources were composed onto the same
  // x_{k-1}.
  const Matrix8d step_noise = transformed(rest, inertial.P) + transformed(gain, visual.P);
  return accept(H, step_noise,
                paper ? Matrix8d(transformed(rest, prior) + transformed(gain, visual.P))
                      : Matrix8d(propagated + step_noise));
}

void HomographyFusion::proveInertial(bool agrees, Duration step) {
  const Duration counted = std::min(step, kMostOfOneStep);
  agreed_ = std::max(Duration(0), agreed_ + (agrees ? counted : -kContradictionWeight * counted));
  inertial_is_proven_ = inertial_is_proven_ || agreed_ >= kProven;
}

Estimate HomographyFusion::accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise,
                                  const Matrix8d& covariance_anchor) {
  Estimate step;
  step.H = normaliseHomography(H_anchor * anchor_.H.inverse());
  step.P = transformed(composeJacobians(step.H, anchor_.H).by_left.inverse(), step_noise);
  anchor_ = {H_anchor, symmetric(covariance_anchor)};
  return step;
}

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
  time_anchor_ = time;
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
