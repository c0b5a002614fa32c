// Corrections of the dead reckoning by altimeter, vision and gravity, each gated by its innovation.
#pragma once

#include <deque>
#include <limits>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/imu_buffer.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {

/// Queues altitudes until the filter reaches their time. After many refusals in a row the height is taken to
/// be wrong and set to the measured one.
class AltitudeCorrection {
 public:
  explicit AltitudeCorrection(const InertialParameters& parameters);

  void add(const AltitudeSample& sample);
  /// Removes and returns the oldest queued sample, if not later than `end`.
  std::optional<AltitudeSample> next(ImuTime end);
  /// Applies samples that arrived after the filter had passed their time, propagated with the vertical speed;
  /// samples that are too old are dropped.
  void correctLate(NavigationState& state, ImuTime now);
  /// `lag_s`: how long before the state's time the height was measured.
  void correct(NavigationState& state, const AltitudeSample& sample, double lag_s);
  void eraseBefore(ImuTime time);

 private:
  Eigen::Vector3d p_IC_;
  double gate_;
  std::deque<AltitudeSample> samples_;
  int refused_in_a_row_ = 0;
};

/// The homography between clone and present pose, as measured by vision. After several refusals in a row the
/// velocity is taken to be wrong: its covariance is inflated, more each time.
class VisionCorrection {
 public:
  explicit VisionCorrection(const InertialParameters& parameters);

  CorrectionReport correct(NavigationState& state, const HomographyObservation& observation,
                           const Camera& camera, const Eigen::Vector3d& p_IC);
  /// Infinity before the first.
  double secondsSinceApplied(CameraTime frame) const;
  void restart();

 private:
  void openVelocity(NavigationState& state);

  double gate_;
  double start_velocity_sigma_;
  double tilt_sigma_;
  double feedback_correlation_frames_;
  std::optional<CameraTime> applied_;
  int refused_in_a_row_ = 0;
  double widening_ = 1;
};

/// Specific force, averaged over the span, as a weak measurement of the vertical at the state's time: slow,
/// and gated on its norm. Skipped while vision constrains the velocity, for then the drone's acceleration is
/// known better than this assumption.
void correctByGravity(NavigationState& state, const ImuSpan& span, const InertialParameters& parameters,
                      double seconds_since_vision);

/// Specific force in I at the state's time, free of bias [m/s^2], as a measurement of the vertical.
/// `variance` of the drone's own acceleration in it [m^2/s^4]. Gated.
void correctVertical(NavigationState& state, const Eigen::Vector3d& force, double variance,
                     const InertialParameters& parameters);

}  // namespace redbee
