// A simulated lens that zooms: its focal length, exactly, and what it says of that.
#pragma once

#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::simulation {

struct ZoomLens {
  Channel logarithm;       ///< of the focal length over the configured one
  double rate_hz = 25;     ///< Hz, of its messages
  double error_sigma = 0;  ///< of the focal length it says, white, relative
  double lag_s = 0;        ///< s, it says what was so long ago
  unsigned seed = 1;       ///< of the error

  /// Focal length over the configured one, exactly.
  double zoom(double t_s) const;
};

/// What it says on [begin_s, end_s] of the trajectory's time. time = start + t.
std::vector<LensSample> simulateLens(const ZoomLens& lens, double begin_s, double end_s, ImuTime start);

}  // namespace redbee::simulation
