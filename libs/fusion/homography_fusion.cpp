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
    std::chrono::milliseconds(250);  ///< a step across lost frames is one test, and one correction

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
  if (parameters_.noise == FusionNoise::kPropagated && isTooUncertain(step)) {
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
                           visual->time_previous >= time_epoch_ && visual->time_previous < chain_.newest() &&
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
  const auto correctedBy = [&](const Matrix8d& gain) -> Estimate {
    return {fromVector(toVector(inertial.H) + gain * innovation),
            transformed(Matrix8d::Identity() - gain, inertial.P) + transformed(gain, visual.P)};
  };
  // What vision skipped it has measured with this step: their errors are corrected together, so that the way
  // across is as good as one step, but not where that leaves a step that is too bad by itself. Of the
  // propagated error the step contains this part alone; the anchor's covariance takes them as independent:
  // too large.
  Matrix8d gain = factors.solve(Matrix8d(prior + sources.across)).transpose();
  Estimate corrected = correctedBy(gain);
  if (!paper && isTooUncertain(stepTo(corrected))) {
    gain = factors.solve(prior).transpose();
    corrected = correctedBy(gain);
  }
  const Matrix8d rest = Matrix8d::Identity() - gain;
  return accept(corrected.H, corrected.P,
                paper ? Matrix8d(transformed(rest, prior) + transformed(gain, visual.P))
                      : Matrix8d(propagated + corrected.P));
}

void HomographyFusion::proveInertial(bool agrees, Duration step) {
  const Duration counted = std::min(step, kMostOfOneStep);
  agreed_ = std::max(Duration(0), agreed_ + (agrees ? counted : -kContradictionWeight * counted));
  inertial_is_proven_ = inertial_is_proven_ || agreed_ >= kProven;
}

bool HomographyFusion::isTooUncertain(const Estimate& step) const {
  return transferSigma(step.H, step.P, width_, height_) > kMaxStepSigma_px;
}

/// The newest step, of the homography that follows on the anchor's, and the covariance that it adds.
Estimate HomographyFusion::stepTo(const Estimate& next) const {
  const Eigen::Matrix3d H = normaliseHomography(next.H * anchor_.H.inverse());
  return {H, transformed(composeJacobians(H, anchor_.H).by_left.inverse(), next.P)};
}

Estimate HomographyFusion::accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise,
                                  const Matrix8d& covariance_anchor) {
  Estimate step = stepTo({H_anchor, step_noise});
  anchor_ = {H_anchor, symmetric(covariance_anchor)};
  return step;
}

}  // namespace redbee
