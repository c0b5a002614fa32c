// Corrections of the filter's state by altimeter, vision and gravity, each gated by its innovation.
#pragma once

#include <deque>
#include <limits>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/imu_buffer.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {

/// Queues altitudes until the filter reaches their time. After many rejections in a row the height is reset
/// to the measured one.
class AltitudeCorrection {
 public:
  explicit AltitudeCorrection(const InertialParameters& parameters);

  /// False for a sample that is not plausible, which is refused.
  bool add(const AltitudeSample& sample);
  /// Removes and returns the oldest queued sample, if not later than `end`.
  std::optional<AltitudeSample> next(ImuTime end);
  /// Applies samples that arrived late, after the filter had passed their time, propagated with the vertical
  /// speed; samples that are too old are dropped.
  void correctLate(NavigationState& state, ImuTime now);
  /// `lag_s`: how long before the state's time the height was measured.
  void correct(NavigationState& state, const AltitudeSample& sample, double lag_s);
  void eraseBefore(ImuTime time);

 private:
  Eigen::Vector3d p_IC_;
  double gate_;
  std::deque<AltitudeSample> samples_;
  int rejected_in_a_row_ = 0;
};

/// Correction by the homography between clone and current pose, as measured by vision. After several
/// rejections in a row the velocity's covariance is inflated, more each time.
class VisionCorrection {
 public:
  explicit VisionCorrection(const InertialParameters& parameters);

  CorrectionReport correct(NavigationState& state, const HomographyObservation& observation,
                           const Camera& camera, const Eigen::Vector3d& p_IC);
  /// Infinity before the first applied correction.
  double secondsSinceApplied(CameraTime frame) const;
  void restart();

 private:
  void inflateVelocity(NavigationState& state);

  double gate_;
  double start_velocity_sigma_;
  double tilt_sigma_;
  double feedback_correlation_frames_;
  std::optional<CameraTime> applied_;
  int rejected_in_a_row_ = 0;
  double velocity_inflation_ = 1;
};

/// Correction of the attitude by the specific force averaged over the span: a weak measurement of the
/// vertical, gated on its norm. Skipped while vision constrains the velocity, as the drone's acceleration is
/// then known better than this assumption.
void correctByGravity(NavigationState& state, const ImuSpan& span, const InertialParameters& parameters,
                      double seconds_since_vision);

/// Correction by a specific force in I at the state's time, without bias [m/s^2], as a measurement of the
/// vertical; gated. `variance`: of the drone's own acceleration [m^2/s^4].
void correctVertical(NavigationState& state, const Eigen::Vector3d& force, double variance,
                     const InertialParameters& parameters);

}  // namespace redbee
