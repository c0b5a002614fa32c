// What holds the dead reckoning to the truth: altimeter, vision, gravity. Each is gated by its innovation.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/imu_buffer.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {

/// Holds altitudes until the filter comes to their time. When the gate has refused many in a row it is the
/// height that is wrong: it is set to the measured one.
class AltitudeCorrection {
 public:
  explicit AltitudeCorrection(const InertialParameters& parameters);

  void add(const AltitudeSample& sample);
  /// The oldest one held, up to `end`; it is taken out.
  std::optional<AltitudeSample> next(int64_t end);
  /// Those that came after the filter had passed their time, carried forward with the vertical speed; too old
  /// ones are dropped.
  void correctLate(NavigationState& state, int64_t now);
  /// `lag_s`: how long before the state's time the height was measured.
  void correct(NavigationState& state, const AltitudeSample& sample, double lag_s);
  void eraseBefore(int64_t utime);

 private:
  Eigen::Vector3d p_IC_;
  double gate_;
  std::deque<AltitudeSample> samples_;
  int refused_in_a_row_ = 0;
};

/// The homography between clone and present pose, as vision saw it. When the gate has refused several in a
/// row it is the velocity that is wrong: its covariance is opened, wider each time.
class VisionCorrection {
 public:
  explicit VisionCorrection(const InertialParameters& parameters);

  CorrectionReport correct(NavigationState& state, const HomographyObservation& observation,
                           const Camera& camera, const Eigen::Vector3d& p_IC);
  /// Infinity before the first.
  double secondsSinceApplied(int64_t frame_utime) const;
  void restart();

 private:
  void openVelocity(NavigationState& state);

  double gate_;
  double start_velocity_sigma_;
  double tilt_sigma_;
  double feedback_correlation_frames_;
  std::optional<int64_t> applied_utime_;
  int refused_in_a_row_ = 0;
  double widening_ = 1;
};

/// Specific force, averaged over the span, as a weak measurement of the vertical at the state's time: slow,
/// and gated on its norm. While vision holds the velocity, the drone's acceleration is known better than this
/// assumption, and it is left out.
void correctByGravity(NavigationState& state, const ImuSpan& span, const InertialParameters& parameters,
                      double seconds_since_vision);

/// Specific force in I at the state's time, free of bias [m/s^2], as a measurement of the vertical.
/// `variance` of the drone's own acceleration in it [m^2/s^4]. Gated.
void correctVertical(NavigationState& state, const Eigen::Vector3d& force, double variance,
                     const InertialParameters& parameters);

}  // namespace redbee
