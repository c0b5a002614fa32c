// The focal length of the camera over time, as a lens that zooms says it.
#pragma once

#include <deque>
#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/lens_parameters.hpp"

namespace redbee {

/// On the IMU's clock.
struct LensSample {
  ImuTime time{};
  double zoom = 1;  ///< focal length over the configured one
};

/// At one time. A lens that does not zoom has the default: known, without an error.
struct Zoom {
  double value = 1;      ///< focal length over the configured one
  double variance = 0;   ///< of its logarithm, anew in each frame; of a guess: lasting
  bool is_known = true;  ///< false: a guess, which `variance` covers
};

/// What LENS states of itself, each where it is known.
struct StatedZoom {
  std::optional<double> focal_px;  ///< in an image of the camera's width
  std::optional<double> range;     ///< 0..1 of the zoom's range
};
/// Focal length over the configured one, `fx_px`; std::nullopt where nothing that was stated gives it.
std::optional<double> zoomOf(const StatedZoom& stated, double fx_px, const LensParameters& parameters);

class LensTrack {
 public:
  /// `camera_timeshift`: camera.timeshift_s.
  explicit LensTrack(const LensParameters& parameters, Duration camera_timeshift = Duration(0))
      : parameters_(parameters),
        shift_(fromSeconds(parameters.timeshift_s) +
               (parameters.on_camera_clock ? camera_timeshift : Duration(0))) {}

  /// In any order; of two with the same time the later one counts. A clock that was set back forgets what
  /// came before. Refuses a zoom that no lens has (from 1/kMostZoom to kMostZoom) or an implausible time, and
  /// then returns false.
  bool add(const LensSample& sample);
  /// Whether a sample as late as `time` has come, or none need be waited for: a lens that speaks less often
  /// than every `max_gap_s` stood still by its last two samples, and the next is not due yet.
  bool reaches(ImuTime time) const;
  /// Interpolated (the logarithm) between the two samples that `time` lies between. Where these are further
  /// apart than `max_gap_s` and differ, or one is missing, it is the nearest one's, as uncertain as a lens is
  /// fast; 1, the configured focal length, where there is none, as uncertain as after a long silence.
  Zoom at(ImuTime time) const;
  /// What lies further back than this is not asked for any more.
  void eraseBefore(ImuTime time);

  static constexpr double kMostZoom = 100;

 private:
  bool areSame(const LensSample& a, const LensSample& b) const;
  bool standsStillAt(ImuTime time) const;
  Zoom guess(double zoom, double away_s) const;
  Zoom guessedBy(const LensSample& nearest, ImuTime time) const;

  LensParameters parameters_;
  Duration shift_;
  std::deque<LensSample> samples_;  ///< in order of time
};

}  // namespace redbee
