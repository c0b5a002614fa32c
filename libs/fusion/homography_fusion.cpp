#include "fusion/homography_fusion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fusion/transfer_sigma.hpp"
#include "geometry/chi_square.hpp"

namespace redbee {
namespace {

constexpr std::size_t kMaxPast = 32;
constexpr int kOverlapGrid = 16;  // px
constexpr double kMinDeterminant = 1e-6;
/// Where the ground goes must be known better than by this, or nothing that is said of single pixels holds.
/// An inertial filter that has not been told its velocity yet is off by ten, one that lost vision a second
/// ago by tenths.
constexpr double kMaxStepSigma_px = 2;
constexpr double kUnknownVariance = 1.0;  // scaled units: half the picture's width

Matrix8d symmetric(const Matrix8d& P) { return 0.5 * (P + P.transpose()); }

/// Neither NaN nor a mirror image nor a collapse of the picture.
bool isUsable(const Eigen::Matrix3d& H) {
  return H.allFinite() && std::abs(H(2, 2)) > 1e-9 && normaliseHomography(H).determinant() > kMinDeterminant;
}

bool isCovariance(const Matrix8d& P) {
  if (!P.allFinite() || P.diagonal().minCoeff() < 0) return false;
  const Eigen::LDLT<Matrix8d> factors(symmetric(P));
  return factors.info() == Eigen::Success && factors.vectorD().minCoeff() > -1e-12 * (1 + P.trace());
}

Matrix8d transformed(const Matrix8d& J, const Matrix8d& P) { return symmetric(J * P * J.transpose()); }

/// The paper's filter runs in its own units, pixels: its Q and P_0 are diagonal there and nowhere else.
ImageScaling workingUnits(const ImageScaling& scaled, FusionNoise noise) {
  ImageScaling units = scaled;
  if (noise == FusionNoise::kPaper) {
    units.T.setIdentity();
    units.T_inverse.setIdentity();
    units.unit_px = 1;
  }
  return units;
}

}  // namespace

const char* toString(FusionSource source) {
  switch (source) {
    case FusionSource::kNone:
      return "none";
    case FusionSource::kInertial:
      return "inertial";
    case FusionSource::kVisual:
      return "visual";
    case FusionSource::kFused:
      return "fused";
  }
  return "unknown";
}

double visualNoiseRatio(int inliers, int outliers) {
  return 1.0 + static_cast<double>(outliers) / std::max(1, inliers);
}

FusionParameters::FusionParameters() {
  paper_Q << 1e-2, 1e-2, 1, 1e-2, 1e-2, 1, 1e-2, 1e-2;
  paper_P0 << 1e-3, 1e-3, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3;
}

HomographyFusion::HomographyFusion(int width, int height, const FusionParameters& parameters)
    : parameters_(parameters),
      width_(width),
      height_(height),
      scaling_(width, height),
      units_(workingUnits(scaling_, parameters.noise)),
      gate_(chiSquareQuantile(parameters.gate_probability, 8)),
      anchor_{Eigen::Matrix3d::Identity(), Matrix8d::Zero()} {}

FusedHomography HomographyFusion::step(int64_t utime, const std::optional<InertialInput>& inertial,
                                       const std::optional<VisualInput>& visual) {
  if (!started_ || utime <= past_.back().utime) return beginChain(utime);
  const Sources sources = anchorSources(inertial, visual);
  if (!sources.inertial && !sources.visual) return beginChain(utime);

  FusedHomography out;
  out.utime_previous = past_.back().utime;
  out.utime = utime;
  past_.push_back({utime, anchor_});  // its step follows
  if (sources.inertial && sources.visual) {
    fuse(*sources.inertial, *sources.visual, out);
  } else if (sources.visual) {
    follow(*sources.visual);
    out.source = FusionSource::kVisual;
    out.visual_accepted = true;
    gated_in_a_row_ = 0;
  } else {
    follow(*sources.inertial);
    out.source = FusionSource::kInertial;
  }
  const Estimate& step = past_.back().step;
  if (!isUsable(step.H) || !isUsable(anchor_.H) || !isCovariance(step.P) || !isCovariance(anchor_.P)) {
    return beginChain(utime);
  }
  // The paper's constant noise is no statement about this step.
  const bool knows_its_error = parameters_.noise == FusionNoise::kPropagated;
  if (knows_its_error && transferSigma(step.H, step.P, width_, height_) > kMaxStepSigma_px) {
    return beginChain(utime);
  }
  if (overlap() < parameters_.min_overlap) anchorAt(utime);
  if (past_.size() > kMaxPast) past_.pop_front();

  out.epoch = epoch_;
  out.utime_anchor = utime_anchor_;
  out.H_step = units_.unscale(step.H);
  out.covariance_step = toScaled(step);
  out.H_anchor = units_.unscale(anchor_.H);
  out.covariance_anchor = toScaled(anchor_);
  return out;
}

/// A homography that starts at a frame s before k-1 becomes one from k-1: H^{k-1:k} = H^{s:k} (H^{s:k-1})^-1.
std::optional<HomographyFusion::Estimate> HomographyFusion::stepFrom(int64_t utime_previous,
                                                                     const Eigen::Matrix3d& H_px,
                                                                     const Matrix8d& covariance) const {
  if (!isUsable(H_px) || !isCovariance(covariance)) return std::nullopt;
  const auto start = std::find_if(past_.begin(), past_.end(),
                                  [&](const Past& past) { return past.utime == utime_previous; });
  if (start == past_.end()) return std::nullopt;
  const Eigen::Matrix3d H = units_.scale(H_px);
  if (!isUsable(H)) return std::nullopt;

  Estimate since{Eigen::Matrix3d::Identity(), Matrix8d::Zero()};
  for (auto past = start + 1; past != past_.end(); ++past) {
    const ComposeJacobians J = composeJacobians(past->step.H, since.H);
    since.P = transformed(J.by_left, past->step.P) + transformed(J.by_right, since.P);
    since.H = normaliseHomography(past->step.H * since.H);
  }
  if (start + 1 == past_.end()) return Estimate{H, symmetric(covariance)};
  if (!isUsable(since.H)) return std::nullopt;
  const Eigen::Matrix3d back = normaliseHomography(since.H.inverse());
  const ComposeJacobians J = composeJacobians(H, back);
  return Estimate{
      normaliseHomography(H * back),
      transformed(J.by_left, covariance) + transformed(J.by_right * inverseJacobian(since.H), since.P)};
}

/// The step composed onto the anchor homography, with the noise that the step adds to it: equation 2.
HomographyFusion::Estimate HomographyFusion::ontoAnchor(const Estimate& step,
                                                        const Vector8d& paper_noise) const {
  const Eigen::Matrix3d H = normaliseHomography(step.H * anchor_.H);
  if (parameters_.noise == FusionNoise::kPaper) return {H, paper_noise.asDiagonal()};
  return {H, transformed(composeJacobians(step.H, anchor_.H).by_left, step.P)};
}

HomographyFusion::Sources HomographyFusion::anchorSources(const std::optional<InertialInput>& inertial,
                                                          const std::optional<VisualInput>& visual) const {
  Sources sources;
  if (inertial) {
    std::optional<Estimate> step =
        stepFrom(inertial->utime_previous, inertial->H, parameters_.process_inflation * inertial->covariance);
    if (step) sources.inertial = ontoAnchor(*step, parameters_.paper_Q);
  }
  if (visual && visual->inliers > 0 && visual->outliers >= 0) {
    const double ratio = visualNoiseRatio(visual->inliers, visual->outliers);
    std::optional<Estimate> step = stepFrom(visual->utime_previous, visual->H,
                                            parameters_.visual_inflation * ratio * visual->covariance);
    if (step) sources.visual = ontoAnchor(*step, ratio * parameters_.paper_P0);
  }
  return sources;
}

/// Covariance in the units of the interface.
Matrix8d HomographyFusion::toScaled(const Estimate& estimate) const {
  if (parameters_.noise != FusionNoise::kPaper) return estimate.P;
  const Eigen::Matrix3d& T_inverse = scaling_.T_inverse;
  const Matrix8d by_entries =
      composeJacobians(scaling_.T, normaliseHomography(estimate.H * T_inverse)).by_right *
      composeJacobians(estimate.H, T_inverse).by_left;
  return transformed(by_entries, estimate.P);
}

/// What the error of the last anchor homography has become in this one.
Matrix8d HomographyFusion::carriedCovariance(const Eigen::Matrix3d& H_anchor) const {
  const Eigen::Matrix3d step = normaliseHomography(H_anchor * anchor_.H.inverse());
  return transformed(composeJacobians(step, anchor_.H).by_right, anchor_.P);
}

void HomographyFusion::follow(const Estimate& source) {
  accept(source.H, source.P, carriedCovariance(source.H) + source.P);
}

void HomographyFusion::fuse(const Estimate& inertial, const Estimate& visual, FusedHomography& out) {
  const bool paper = parameters_.noise == FusionNoise::kPaper;
  const Matrix8d carried = carriedCovariance(inertial.H);
  const Matrix8d prior = paper ? Matrix8d(carried + inertial.P) : inertial.P;
  const Matrix8d S = symmetric(prior + visual.P);
  const Eigen::LDLT<Matrix8d> factors(S);
  out.has_innovation = true;
  const Vector8d innovation = toVector(visual.H) - toVector(inertial.H);
  out.test_ratio = innovation.dot(factors.solve(innovation)) / gate_;
  out.innovation = toVector(scaling_.scale(units_.unscale(visual.H))) -
                   toVector(scaling_.scale(units_.unscale(inertial.H)));
  out.innovation_covariance = toScaled({inertial.H, S});

  const bool agrees = factors.isPositive() && out.test_ratio <= 1;
  if (!agrees && ++gated_in_a_row_ <= parameters_.max_gated_in_a_row) {
    follow(inertial);
    out.source = FusionSource::kInertial;
    return;
  }
  out.visual_accepted = true;
  gated_in_a_row_ = 0;
  if (!agrees) {
    follow(visual);
    out.source = FusionSource::kVisual;
    anchorAt(out.utime);
    return;
  }
  out.source = FusionSource::kFused;
  const Matrix8d gain = factors.solve(prior).transpose();
  const Matrix8d rest = Matrix8d::Identity() - gain;
  const Eigen::Matrix3d H = fromVector(toVector(inertial.H) + gain * innovation);
  // The step's error holds neither source's share of the carried error: both were built on the same x_{k-1}.
  const Matrix8d step_noise = transformed(rest, inertial.P) + transformed(gain, visual.P);
  accept(H, step_noise,
         paper ? Matrix8d(transformed(rest, prior) + transformed(gain, visual.P))
               : Matrix8d(carried + step_noise));
}

void HomographyFusion::accept(const Eigen::Matrix3d& H_anchor, const Matrix8d& step_noise,
                              const Matrix8d& covariance_anchor) {
  Estimate& step = past_.back().step;
  step.H = normaliseHomography(H_anchor * anchor_.H.inverse());
  step.P = transformed(composeJacobians(step.H, anchor_.H).by_left.inverse(), step_noise);
  anchor_ = {H_anchor, symmetric(covariance_anchor)};
}

void HomographyFusion::anchorAt(int64_t utime) {
  ++epoch_;
  utime_anchor_ = utime;
  anchor_ = {Eigen::Matrix3d::Identity(), Matrix8d::Zero()};
}

FusedHomography HomographyFusion::beginChain(int64_t utime) {
  FusedHomography out;
  out.utime_previous = past_.empty() ? utime : past_.back().utime;
  if (started_ && past_.size() > 1 && past_.back().utime == utime) {
    out.utime_previous = past_[past_.size() - 2].utime;
  }
  if (started_) ++epoch_;
  started_ = true;
  utime_anchor_ = utime;
  anchor_ = {Eigen::Matrix3d::Identity(), Matrix8d::Zero()};
  gated_in_a_row_ = 0;
  past_.assign(1, {utime, anchor_});

  out.utime = utime;
  out.epoch = epoch_;
  out.utime_anchor = utime;
  out.H_step.setIdentity();
  out.covariance_step = kUnknownVariance * Matrix8d::Identity();
  out.H_anchor.setIdentity();
  out.covariance_anchor.setZero();
  return out;
}

/// Share of the anchor frame's area that is still in the newest frame.
double HomographyFusion::overlap() const {
  const Eigen::Matrix3d H = units_.unscale(anchor_.H);
  int inside = 0;
  int all = 0;
  for (int v = kOverlapGrid / 2; v < height_; v += kOverlapGrid) {
    for (int u = kOverlapGrid / 2; u < width_; u += kOverlapGrid, ++all) {
      const Eigen::Vector3d x = H * Eigen::Vector3d(u, v, 1);
      if (x.z() <= 0) continue;
      const double x_px = x.x() / x.z();
      const double y_px = x.y() / x.z();
      inside += x_px >= -0.5 && x_px <= width_ - 0.5 && y_px >= -0.5 && y_px <= height_ - 0.5;
    }
  }
  return all > 0 ? static_cast<double>(inside) / all : 0.0;
}

}  // namespace redbee
