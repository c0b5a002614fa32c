#include "redbee/inertial/corrections.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/products.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/inertial/homography_measurement.hpp"

namespace redbee {
namespace {

constexpr std::size_t kMaxAltitudes = 1024;
constexpr double kMaxAltitudeLag = 0.5;  // s
constexpr int kAltitudeRefusals = 10;
constexpr int kVisionRefusals = 5;
constexpr double kMaxWidening = 32;
constexpr double kVisionHolds = 1.0;  // s after a correction by vision during which the velocity is accurate

/// Resets the variance of three neighbouring errors, uncorrelated with all others.
void reopen(ErrorCovariance& P, int index, const Eigen::Matrix3d& covariance) {
  P.middleRows<3>(index).setZero();
  P.middleCols<3>(index).setZero();
  P.block<3, 3>(index, index) = covariance;
}

}  // namespace

AltitudeCorrection::AltitudeCorrection(const InertialParameters& parameters)
    : p_IC_(parameters.extrinsics.p_IC),
      gate_(chiSquareQuantile(parameters.innovation_gate_probability, 1)) {}

bool AltitudeCorrection::add(const AltitudeSample& sample) {
  const bool is_usable = isPlausibleTime(sample.time) && std::isfinite(sample.height_m) &&
                         std::isfinite(sample.sigma_m) && sample.sigma_m > 0;
  if (!is_usable) return false;
  const auto place =
      std::lower_bound(samples_.begin(), samples_.end(), sample.time,
                       [](const AltitudeSample& held, ImuTime time) { return held.time < time; });
  if (place != samples_.end() && place->time == sample.time) return true;
  samples_.insert(place, sample);
  if (samples_.size() > kMaxAltitudes) samples_.pop_front();
  return true;
}

std::optional<AltitudeSample> AltitudeCorrection::next(ImuTime end) {
  if (samples_.empty() || samples_.front().time > end) return std::nullopt;
  const AltitudeSample sample = samples_.front();
  samples_.pop_front();
  return sample;
}

void AltitudeCorrection::correctLate(NavigationState& state, ImuTime now) {
  while (const std::optional<AltitudeSample> sample = next(now)) {
    const double lag = seconds(now - sample->time);
    if (lag <= kMaxAltitudeLag) correct(state, *sample, lag);
  }
}

void AltitudeCorrection::eraseBefore(ImuTime time) {
  while (!samples_.empty() && samples_.front().time < time) samples_.pop_front();
}

void AltitudeCorrection::correct(NavigationState& state, const AltitudeSample& sample, double lag_s) {
  using Scalar = Eigen::Matrix<double, 1, 1>;
  MeasurementJacobian<1> H = cameraHeightJacobian(state, p_IC_);
  H(kVelocity + 2) = -lag_s;
  const Scalar R(sample.sigma_m * sample.sigma_m);
  const Scalar innovation(sample.height_m - (cameraHeight(state, p_IC_) - lag_s * state.v_GI.z()));
  const Scalar S_inverse((H * state.P * H.transpose() + R).inverse());
  if (innovation.value() * S_inverse.value() * innovation.value() <= gate_) {
    rejected_in_a_row_ = 0;
    update<1>(state, H, innovation, R, S_inverse);
    return;
  }
  if (++rejected_in_a_row_ < kAltitudeRefusals) return;
  rejected_in_a_row_ = 0;
  state.p_GI.z() += innovation.value();
  state.p_GI_clone.z() += innovation.value();
  // The clone's height is off by the same amount: the common part's variance is inflated, that of their
  // difference stays.
  const double opened = innovation.value() * innovation.value();
  for (const int i : {kPosition + 2, kClonePosition + 2}) {
    for (const int j : {kPosition + 2, kClonePosition + 2}) state.P(i, j) += opened;
  }
}

VisionCorrection::VisionCorrection(const InertialParameters& parameters)
    : gate_(chiSquareQuantile(parameters.innovation_gate_probability, 8)),
      start_velocity_sigma_(parameters.start_velocity_sigma),
      tilt_sigma_(parameters.gravity_sigma / parameters.gravity),
      feedback_correlation_frames_(parameters.feedback_correlation_frames) {}

CorrectionReport VisionCorrection::correct(NavigationState& state, const HomographyObservation& observation,
                                           const Camera& camera, const Eigen::Vector3d& p_IC) {
  const ImageScaling scaling(camera.ideal().width, camera.ideal().height);
  const PlaneMotion motion = cameraMotion(state, p_IC);
  const HomographyMeasurement z = homographyMeasurement(state, motion, motionJacobians(state, motion, p_IC),
                                                        scaledMatrices(state, camera));
  const Vector8d innovation = toVector(scaling.scale(observation.H)) - z.predicted;
  const Matrix8d R =
      feedback_correlation_frames_ * observation.covariance + z.optics_covariance + z.second_order_covariance;
  const Matrix8d S = z.linear_covariance + R;
  const LdltFactors factors(S);
  if (!innovation.allFinite() || !factors.succeeded() || !factors.isPositive()) return {};
  const Matrix8d S_inverse = factors.inverse();
  const double test_ratio = innovation.dot(S_inverse * innovation) / gate_;
  if (!std::isfinite(test_ratio)) return {};
  if (test_ratio > 1) {
    if (++rejected_in_a_row_ >= kVisionRefusals) inflateVelocity(state);
    return {false, test_ratio};
  }
  update<8>(state, z.jacobian, innovation, R, S_inverse);
  rejected_in_a_row_ = 0;
  velocity_inflation_ = 1;
  applied_ = observation.time;
  return {true, test_ratio};
}

void VisionCorrection::inflateVelocity(NavigationState& state) {
  rejected_in_a_row_ = 0;
  const double sigma = velocity_inflation_ * start_velocity_sigma_;
  reopen(state.P, kVelocity, sigma * sigma * Eigen::Matrix3d::Identity());
  // Tilt only: yaw means nothing here and stays as it is.
  const Eigen::Matrix3d across = skew(state.R_GI.row(2));
  state.P.block<3, 3>(kAttitude, kAttitude) += tilt_sigma_ * tilt_sigma_ * across * across.transpose();
  velocity_inflation_ = std::min(2 * velocity_inflation_, kMaxWidening);
}

double VisionCorrection::secondsSinceApplied(CameraTime frame) const {
  if (!applied_) return std::numeric_limits<double>::infinity();
  return seconds(frame - *applied_);
}

void VisionCorrection::restart() {
  applied_.reset();
  rejected_in_a_row_ = 0;
  velocity_inflation_ = 1;
}

void correctByGravity(NavigationState& state, const ImuSpan& span, const InertialParameters& parameters,
                      double seconds_since_vision) {
  if (seconds_since_vision < kVisionHolds || span.measured == 0) return;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const ImuKnot& knot : span.knots) force += knot.sample.accel - state.accel_bias;
  force /= static_cast<double>(span.knots.size());
  if (std::abs(force.norm() - parameters.gravity) > parameters.gravity_gate) return;

  // The drone's own acceleration is correlated in time: over a much shorter span the error is not
  // independent.
  const double duration = seconds(span.knots.back().sample.time - span.knots.front().sample.time);
  if (duration <= 0) return;
  const double variance = parameters.gravity_sigma * parameters.gravity_sigma *
                          std::max(1.0, parameters.gravity_correlation_s / duration);
  correctVertical(state, force, variance, parameters);
}

void correctVertical(NavigationState& state, const Eigen::Vector3d& force, double variance,
                     const InertialParameters& parameters) {
  const Eigen::Matrix3d R = variance * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d expected = state.R_GI.transpose() * Eigen::Vector3d(0, 0, parameters.gravity);
  MeasurementJacobian<3> H = MeasurementJacobian<3>::Zero();
  H.middleCols<3>(kAttitude) = skew(expected);
  H.middleCols<3>(kAccelBias).setIdentity();
  const Eigen::Matrix3d S_inverse = mappedCovariancePlus(H, state.P, R).inverse();
  const Eigen::Vector3d innovation = force - expected;
  if (innovation.dot(S_inverse * innovation) > chiSquareQuantile(parameters.innovation_gate_probability, 3)) {
    return;
  }
  update<3>(state, H, innovation, R, S_inverse);
}

}  // namespace redbee
